// The questions on the terminal, answered from a text; and how files are told apart.

#include "prepare/guess/wizard.h"

#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "geometry/mesh_files.h"
#include "prepare/guess/muscle_contacts.h"
#include "prepare/guess/part_files.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct Asked {
  Strangers strangers;
  GuessedRecipe guess;
  std::string shown;
};

/// The rod between two boxes, of which the second is 15 mm away from it.
Asked ask(const std::string& answers) {
  testing::SmallLimb limb = testing::small_limb();
  for (Vec3& p : limb.bones[1].surface.positions_m) p.x() += 0.015;
  Asked asked;
  asked.strangers.bones = {{"a", limb.bones[0].surface}, {"b", limb.bones[1].surface}};
  asked.strangers.muscles = {{"rod", limb.muscles[0].surface}};
  asked.guess = guess_recipe(asked.strangers, {});
  std::istringstream in(answers);
  std::ostringstream out;
  Wizard(in, out).ask_recipe(asked.strangers, {}, asked.guess);
  asked.shown = out.str();
  return asked;
}

TEST(Wizard, TakesTheGuessWhereTheInputEnds) {
  const Asked asked = ask("");
  EXPECT_EQ(asked.guess.anatomy.side, "left");
  EXPECT_EQ(asked.guess.anatomy.joints.at(0).type, anatomy::JointType::Weld);
  EXPECT_THAT(asked.shown, HasSubstr("15.0 mm"));
}

TEST(Wizard, TakesAnswersAndAsksAgainForWhatIsNotAllowed) {
  // name, species, side (twice), source, licence, bone of the insertion, axis, names of a, b and rod
  const Asked asked = ask("knee\nFelis catus\nrigth\nright\nCT\nCC0\na\n0 2 0\n\n\n\n\nbelly\nVenter\n");
  const AnatomyData& anatomy = asked.guess.anatomy;
  EXPECT_EQ(anatomy.name, "knee");
  EXPECT_EQ(anatomy.species, "Felis catus");
  EXPECT_EQ(anatomy.side, "right");
  EXPECT_THAT(asked.shown, HasSubstr("the nearest is right"));
  EXPECT_EQ(anatomy.muscles.at(0).insertions.at(0).bones.at(0), "a");
  EXPECT_EQ(anatomy.joints.at(0).type, anatomy::JointType::Hinge);
  EXPECT_EQ(anatomy.joints.at(0).axes.at(0), Vec3::UnitY());
  EXPECT_EQ(anatomy.muscles.at(0).mechanics.name_en, "belly");
  EXPECT_EQ(anatomy.muscles.at(0).mechanics.name_la, "Venter");
}

class PartFiles : public ::testing::Test {
 protected:
  PartFiles() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~PartFiles() override { fs::remove_all(folder_); }

  void put(const std::string& name, double scale) const {
    geometry::TriangleMesh rod = testing::rod_surface({});
    for (Vec3& p : rod.positions_m) p *= scale;
    fs::create_directories((folder_ / name).parent_path());
    geometry::write_ply(rod, folder_ / name);
  }

  fs::path folder_ = fs::path(::testing::TempDir()) / ("part_files_test" + std::to_string(::getpid()));
  const KnownParts known_ = {{"femur", "Os femoris", "Femur", true, {}}, {"gracilis", "", "Gracilis", false, {}}};
};

TEST_F(PartFiles, AreToldApartByNameAndAskedAboutElse) {
  for (const char* name : {"Femur_L.ply", "M. gracilis.ply", "Segment_3.ply"}) put(name, 1.0);
  std::vector<PartFile> parts = sort_parts(find_inputs({folder_}).surfaces, {}, known_);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].key, "femur");
  EXPECT_TRUE(parts[0].bone);
  EXPECT_EQ(parts[1].key, "gracilis");
  EXPECT_FALSE(parts[2].sure);
  EXPECT_THAT(decisions_on(parts).at(0).text, HasSubstr("--bones Segment_3"));
  std::istringstream in("bone\n");
  std::ostringstream out;
  Wizard(in, out).ask_parts(parts);
  EXPECT_TRUE(parts[2].bone);
}

TEST_F(PartFiles, AreToldApartByTheirFolderOrByThePerson) {
  put("bones/x.ply", 1.0);
  put("muscles/femur.ply", 1.0);
  const auto files = find_inputs({folder_}).surfaces;
  EXPECT_TRUE(sort_parts(files, {}, known_).at(0).bone);
  EXPECT_FALSE(sort_parts(files, {}, known_).at(1).bone);
  EXPECT_TRUE(sort_parts(files, {"Femur"}, known_).at(1).bone);
  EXPECT_FALSE(sort_parts(files, {"Femur"}, known_).at(0).bone);
  try {
    sort_parts(files, {"femurr"}, known_);
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::Usage);
    EXPECT_THAT(error.what(), HasSubstr("nearest is \"femur\""));
  }
}

TEST_F(PartFiles, KeepTheirNamesWhereTwoMeanTheSame) {
  for (const char* name : {"femur_left.ply", "femur_right.ply", "femur-left.ply"}) put(name, 1.0);
  const auto parts = sort_parts(find_inputs({folder_}).surfaces, {}, known_);
  EXPECT_EQ(parts[0].key, "femur_left");
  EXPECT_EQ(parts[1].key, "femur_left_2");
  EXPECT_EQ(parts[2].key, "femur_right");
}

TEST_F(PartFiles, GetAUnitThatMakesThemALimb) {
  const auto unit_of = [&](double scale, std::string units) {
    put("rod.ply", scale);
    std::vector<std::string> notes;
    const auto parts = sort_parts(find_inputs({folder_}).surfaces, {}, known_);
    const Strangers strangers = read_strangers(parts, units, notes);
    return std::pair(units, long_axis(strangers.muscles.at(0).surface).length_m());
  };
  EXPECT_EQ(unit_of(1.0, "").first, "m");
  EXPECT_EQ(unit_of(1000.0, "").first, "mm");
  EXPECT_NEAR(unit_of(1000.0, "").second, 0.1, 1e-9);
  EXPECT_NEAR(unit_of(100.0, "cm").second, 0.1, 1e-9);
  EXPECT_THROW(unit_of(1e6, ""), Error);
  EXPECT_THROW(unit_of(1.0, "mm"), Error);
}

}  // namespace
}  // namespace myotact::prepare
