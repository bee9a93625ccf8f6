// What is guessed of parts whose names say nothing: ends, bodies, joints; and that the recipe written is the one
// guessed.

#include "prepare/guess/guess_recipe.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "prepare/recipe/make_limb.h"
#include "prepare/recipe/read_recipe.h"
#include "prepare/recipe/read_scan.h"
#include "prepare/recipe/recipe_text.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Two boxes and the rod from one to the other, under names that say nothing.
Strangers two_boxes_and_a_rod() {
  testing::SmallLimb limb = testing::small_limb();
  Strangers strangers;
  strangers.bones = {{"segment_1", limb.bones[0].surface}, {"segment_2", limb.bones[1].surface}};
  strangers.muscles = {{"segment_3", limb.muscles[0].surface}};
  return strangers;
}

const Decision* decision_on(const GuessedRecipe& guess, const std::string& about, const std::string& part) {
  for (const Decision& decision : guess.decisions) {
    if (decision.about == about && decision.part == part && !decision.sure) return &decision;
  }
  return nullptr;
}

TEST(GuessRecipe, FixesAMuscleWhereItTouchesBones) {
  const GuessedRecipe guess = guess_recipe(two_boxes_and_a_rod(), {});
  const MuscleData& rod = guess.anatomy.muscles.at(0);
  std::vector<std::string> bones = {rod.origins.at(0).bones.at(0), rod.insertions.at(0).bones.at(0)};
  EXPECT_THAT(bones, ::testing::UnorderedElementsAre("segment_1", "segment_2"));
  EXPECT_NEAR((rod.origins[0].point_m - rod.insertions[0].point_m).norm(), 0.10, 0.012);
  EXPECT_GT(rod.origins[0].area_m2, 0.5 * testing::rod_section_m2({}));
  EXPECT_EQ(decision_on(guess, "attachments", "segment_3"), nullptr);  // nothing unsure
  EXPECT_NE(decision_on(guess, "joints", "segment_1_segment_2"), nullptr);
}

TEST(GuessRecipe, TakesForcesByTheStatedRuleAndSaysSo) {
  const MuscleData rod = guess_recipe(two_boxes_and_a_rod(), {}).anatomy.muscles.at(0);
  const double volume_m3 = 0.10 * testing::rod_section_m2({});
  EXPECT_NEAR(rod.mechanics.optimal_fibre_m, 0.05, 1e-6);
  EXPECT_NEAR(rod.mechanics.peak_force_N, 3e5 * volume_m3 / 0.05, 1e-3 * rod.mechanics.peak_force_N);
  EXPECT_THAT(rod.mechanics.estimated, Contains("peak_force_N"));
  EXPECT_THAT(rod.mechanics.sources.at(0), HasSubstr("not measured: default"));
}

TEST(GuessRecipe, WeldsBonesFromTheTopmostOutwards) {
  Strangers limb;
  for (int i = 0; i < 4; ++i) {  // a chain that hangs down, listed from its end
    const Vec3 low(0.0, 0.0, 0.1 * i);
    limb.bones.push_back({"b" + std::to_string(i), testing::box_surface(low, low + Vec3(0.02, 0.02, 0.098))});
  }
  const AnatomyData anatomy = guess_recipe(limb, {}).anatomy;
  ASSERT_EQ(anatomy.joints.size(), 3u);
  for (const anatomy::Joint& joint : anatomy.joints) {
    EXPECT_EQ(joint.type, anatomy::JointType::Weld);
    EXPECT_EQ(joint.parent, joint.child + 1);
    EXPECT_NEAR(joint.centre_m.z(), 0.1 * joint.parent - 0.001, 1e-9);
  }
  EXPECT_NEAR(anatomy.bodies[0].mass_kg, 1800.0 * 0.02 * 0.02 * 0.098, 1e-9);
}

TEST(GuessRecipe, SaysHowFarAnEndIsFromTheNearestBone) {
  Strangers strangers = two_boxes_and_a_rod();
  for (Vec3& p : strangers.bones[1].surface.positions_m) p.x() += 0.015;
  const GuessedRecipe guess = guess_recipe(strangers, {});
  const Decision* decision = decision_on(guess, "attachments", "segment_3");
  ASSERT_NE(decision, nullptr);
  EXPECT_THAT(decision->text, HasSubstr("15.0 mm"));
  EXPECT_THAT(decision->text, HasSubstr("segment_2"));
  EXPECT_THAT(decision->suggestions, ElementsAre("segment_2"));
}

TEST(GuessRecipe, HoldsAMuscleWithoutBonesAtBothTips) {
  Strangers strangers;
  strangers.muscles = {{"lone", testing::rod_surface({})}};
  const AnatomyData anatomy = guess_recipe(strangers, {}).anatomy;
  ASSERT_EQ(anatomy.bodies.size(), 1u);
  EXPECT_TRUE(anatomy.joints.empty());
  const MuscleData& lone = anatomy.muscles.at(0);
  EXPECT_EQ(lone.origins.at(0).body, 0);
  EXPECT_EQ(lone.insertions.at(0).body, 0);
  const double apart_m = std::abs(lone.origins[0].point_m.x() - lone.insertions[0].point_m.x());
  EXPECT_NEAR(apart_m, 0.10, 0.011);
}

TEST(GuessRecipe, RefusesNothingAtAllAndWhatIsNoSurface) {
  EXPECT_THROW(guess_recipe({}, {}), Error);
  const auto refuses = [](auto&& spoil) {
    Strangers strangers = two_boxes_and_a_rod();
    spoil(strangers.bones[1].surface);
    EXPECT_THROW(guess_recipe(strangers, {}), Error);
  };
  refuses([](geometry::TriangleMesh& mesh) { mesh.triangles.clear(); });
  refuses([](geometry::TriangleMesh& mesh) { mesh.triangles[3][1] = 99; });
  refuses([](geometry::TriangleMesh& mesh) { mesh.positions_m[2].y() = std::numeric_limits<double>::quiet_NaN(); });
}

/// All triangles in one point: no axis, no area. The repair refuses it by name; nothing may break before.
TEST(GuessRecipe, BearsAMuscleWithoutExtent) {
  Strangers strangers = two_boxes_and_a_rod();
  for (Vec3& p : strangers.muscles[0].surface.positions_m) p = Vec3::Constant(0.01);
  const AnatomyData anatomy = guess_recipe(strangers, {}).anatomy;
  ASSERT_EQ(anatomy.muscles.size(), 1u);
  for (const auto& sites : {anatomy.muscles[0].origins, anatomy.muscles[0].insertions}) {
    ASSERT_FALSE(sites.empty());
    EXPECT_EQ(sites[0].point_m, Vec3(0.01, 0.01, 0.01));
  }
}

Strangers with_markup(MarkupKind kind, const std::string& name, const std::vector<Vec3>& points_m) {
  Strangers strangers = two_boxes_and_a_rod();
  Markup markup{kind, "marks.mrk.json", name, {}};
  for (const Vec3& p : points_m) markup.points.push_back({name, p});
  strangers.markups = {markup};
  return strangers;
}

TEST(GuessRecipe, MakesAMarkedLineAHinge) {
  const Strangers strangers = with_markup(MarkupKind::Line, "joint elbow segment 1 segment 2",
                                          {Vec3(0.05, 0.02, -0.02), Vec3(0.05, -0.02, -0.02)});
  const AnatomyData anatomy = guess_recipe(strangers, {}).anatomy;
  ASSERT_EQ(anatomy.joints.size(), 1u);
  const anatomy::Joint& elbow = anatomy.joints[0];
  EXPECT_EQ(elbow.key, "elbow");
  EXPECT_EQ(elbow.type, anatomy::JointType::Hinge);
  // The first box is a little higher, so it stays the parent; the rod runs 20 mm above the axis and flexes.
  EXPECT_NEAR((elbow.centre_m - Vec3(0.05, 0.0, -0.02)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(elbow.axes.at(0).y()), 1.0, 1e-12);
  ASSERT_EQ(anatomy.groups.size(), 1u);
  EXPECT_THAT(anatomy.groups[0].flexors, ElementsAre("segment_3"));
}

TEST(GuessRecipe, TakesMarkedEndsAndLines) {
  const AnatomyData marked =
      guess_recipe(with_markup(MarkupKind::Points, "insertion segment_3", {Vec3(0.10, 0.005, 0.01)}), {}).anatomy;
  EXPECT_EQ(marked.muscles.at(0).insertions.at(0).point_m, Vec3(0.10, 0.005, 0.01));
  const std::vector<Vec3> line_m = {Vec3(0.0, 0.0, 0.0), Vec3(0.05, 0.0, 0.002), Vec3(0.10, 0.0, 0.0)};
  const AnatomyData lined = guess_recipe(with_markup(MarkupKind::Curve, "line segment_3", line_m), {}).anatomy;
  const auto& line = lined.muscles.at(0).line;
  ASSERT_EQ(line.size(), 3u);
  EXPECT_EQ(line.front().kind, anatomy::LinePointKind::Origin);
  EXPECT_EQ(line[1].position_m, line_m[1]);
  EXPECT_NE(line.front().body, line.back().body);
}

/// Read again as a file would be.
AnatomyData read_back(const AnatomyData& anatomy) {
  const fs::path file = fs::path(::testing::TempDir()) / "guess_recipe_test.json";
  std::ofstream(file) << recipe_text(anatomy);
  AnatomyData read = read_recipe(file);
  fs::remove(file);
  return read;
}

TEST(RecipeText, IsReadBackToTheLastBit) {
  Strangers strangers = with_markup(MarkupKind::Line, "joint elbow segment 1 segment 2",
                                    {Vec3(0.051, 0.021, -0.023), Vec3(0.047, -0.02, -0.02)});
  strangers.markups.push_back(
      {MarkupKind::Curve, "", "line segment_3", {{"", {0.0, 0.0, 0.0}}, {"", {0.1, 0.0, 0.0}}}});
  AnatomyData guessed = guess_recipe(strangers, {}).anatomy;
  guessed.units = "mm";
  guessed.bones[0].file = "bones/Segment 1.stl";
  const AnatomyData read = read_back(guessed);
  EXPECT_EQ(recipe_text(read), recipe_text(guessed));
  EXPECT_EQ(read.joints.at(0).axes, guessed.joints.at(0).axes);
  EXPECT_EQ(read.muscles.at(0).origins.at(0).point_m, guessed.muscles.at(0).origins.at(0).point_m);
  EXPECT_EQ(read.muscles.at(0).line.size(), 2u);
  EXPECT_EQ(read.units, "mm");
  EXPECT_EQ(read.bones.at(0).file, "bones/Segment 1.stl");
}

TEST(PartNames, TellBonesFromMuscles) {
  for (const char* bone :
       {"Femur_L", "os coxae", "BONE_12", "Phalanx proximalis II", "metatarsal 3", "tibia", "Knochen 4"}) {
    EXPECT_EQ(kind_by_name(bone), LikelyKind::Bone) << bone;
  }
  for (const char* muscle :
       {"M. tibialis cranialis", "flexor carpi radialis", "biceps_femoris", "Musculus radius", "Muskel 7"}) {
    EXPECT_EQ(kind_by_name(muscle), LikelyKind::Muscle) << muscle;
  }
  EXPECT_EQ(kind_by_name("Segment_3"), LikelyKind::Unknown);
}

TEST(PartNames, FindWhatANameMeansAndWhatItResembles) {
  const KnownParts known = {{"tibia", "Tibia", "Tibia", true, {"shin bone"}},
                            {"tibialis_cranialis", "Musculus tibialis cranialis", "Cranial tibial", false, {}},
                            {"triceps_long", "", "Triceps, long head", false, {"triceps"}},
                            {"triceps_medial", "", "Triceps, medial head", false, {"triceps"}}};
  EXPECT_EQ(find_known("Left shin-bone", known), 0u);
  EXPECT_EQ(find_known("M. tibialis cranialis (L)", known), 1u);
  EXPECT_FALSE(find_known("triceps", known));
  EXPECT_FALSE(find_known("Segment 3", known));
  EXPECT_EQ(similar_parts("tibialis_cranialus", known).front(), "tibialis_cranialis");
  EXPECT_TRUE(similar_parts("Segment_3", known).empty());
  EXPECT_EQ(part_key("  M. Bizeps (L)!"), "m_bizeps_l");
  EXPECT_EQ(part_key("\xc3\xa4\xc3\xb6"), "part");
}

/// Whether a bone is one of those wanted. The paw's bones, which are one file and lie a millimetre apart, count as one.
bool is_one_of(const std::string& bone, const std::vector<std::string>& wanted, const AnatomyData& recipe) {
  const auto name = [&](const std::string& key) {
    const auto found =
        std::find_if(recipe.bones.begin(), recipe.bones.end(), [&](const BoneData& b) { return b.key == key; });
    return found != recipe.bones.end() && found->piece_m ? found->file : key;
  };
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& key) { return name(key) == name(bone); });
}

/// Whether any of the sites that the recipe names has the guess's first bone.
bool names_first_bone_of(const std::vector<AttachmentSite>& named, const AttachmentSite& guess,
                         const AnatomyData& recipe) {
  return !guess.bones.empty() && std::any_of(named.begin(), named.end(), [&](const AttachmentSite& site) {
    return is_one_of(guess.bones.front(), site.bones, recipe);
  });
}

/// Known anatomy: bones that the built-in recipe names for the ends of muscles, which were read in textbooks. The
/// trunk, from which four muscles come, is not among the surfaces.
TEST(GuessRecipe, FindsTheBonesOfADogsMuscles) {
  const char* folder = std::getenv("MYOTACT_CANINE_DIR");
  if (!folder) GTEST_SKIP() << "MYOTACT_CANINE_DIR is not set: the full canine meshes are not there";
  int ends = 0, right = 0;
  for (const char* limb : {"forelimb", "hindlimb"}) {
    const AnatomyData recipe = read_recipe(data_folder() / "assets" / "canine" / (std::string(limb) + ".json"));
    const Scan scan = read_scan({fs::path(folder) / (std::string(limb) + "_left")}, recipe);
    Strangers strangers;
    strangers.bones = scan.bones;
    strangers.muscles = scan.muscles;
    const AnatomyData guessed = guess_recipe(strangers, {}).anatomy;
    for (std::size_t m = 0; m < guessed.muscles.size(); ++m) {
      for (const bool origin : {true, false}) {
        const auto& sites = origin ? recipe.muscles[m].origins : recipe.muscles[m].insertions;
        const AttachmentSite& site = (origin ? guessed.muscles[m].origins : guessed.muscles[m].insertions).front();
        ++ends;
        right += names_first_bone_of(sites, site, recipe);
      }
    }
  }
  EXPECT_GE(right, 0.9 * ends) << right << " of " << ends;
}

}  // namespace
}  // namespace myotact::prepare
