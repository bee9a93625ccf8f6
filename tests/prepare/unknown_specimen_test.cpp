// The program on parts that no recipe knows: a specimen, the recipe that was guessed, and the same from that recipe.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "anatomy/specimen.h"
#include "core/exit_status.h"
#include "core/file.h"
#include "geometry/mesh_files.h"
#include "prepare/phantom_files.h"
#include "prepare/phantom_volume.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class UnknownSpecimen : public ::testing::Test {
 protected:
  UnknownSpecimen() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~UnknownSpecimen() override { fs::remove_all(folder_); }

  /// Exit status. Nobody is at the terminal: what asks would wait for ever.
  int run(const std::string& arguments) {
    const std::string coarse = arguments.starts_with("check") ? "" : " --tets 120";
    const std::string command = std::string(MYOTACT_PREPARE) + " " + arguments + coarse + " </dev/null >" +
                                path("stdout") + " 2>" + path("stderr");
    const int status = std::system(command.c_str());
    output_ = read_file(path("stdout"));
    error_ = read_file(path("stderr"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Two boxes and a rod between them in millimetres, all in one folder, under names that say nothing.
  std::string boxes_and_rod() const {
    const testing::SmallLimb limb = testing::small_limb();
    put("Segment_1", limb.bones[0].surface);
    put("Segment_2", limb.bones[1].surface);
    put("Segment_3", limb.muscles[0].surface);
    return path("scan");
  }

  void put(const std::string& name, geometry::TriangleMesh surface) const {
    for (Vec3& p : surface.positions_m) p *= 1e3;
    fs::create_directories(folder_ / "scan");
    geometry::write_ply(surface, folder_ / "scan" / (name + ".ply"));
  }

  /// Files that differ, of two specimens; the report holds times.
  static std::vector<std::string> differences(const fs::path& a, const fs::path& b) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(a)) {
      const fs::path name = entry.path().lexically_relative(a);
      if (!entry.is_regular_file() || name == "report.html") continue;
      if (!fs::exists(b / name) || read_file(a / name) != read_file(b / name)) names.push_back(name.string());
    }
    return names;
  }

  fs::path folder_ = fs::path(::testing::TempDir()) /
                     (std::string("unknown_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  std::string output_, error_;
};

constexpr int kDone = static_cast<int>(ExitStatus::Done);

TEST_F(UnknownSpecimen, ComesOutTheSameFromTheRecipeThatWasGuessed) {
  const std::string scan = boxes_and_rod();
  ASSERT_EQ(run(scan + " --bones Segment_1,Segment_2 -o " + path("first") + " --write-recipe " + path("r.json")), kDone)
      << error_;
  EXPECT_THAT(output_, HasSubstr("to decide (units): taken as mm"));
  EXPECT_EQ(read_file(path("r.json")), read_file(folder_ / "first" / "recipe.json"));
  ASSERT_EQ(run(scan + " -o " + path("second") + " --recipe " + path("r.json")), kDone) << error_;
  EXPECT_THAT(differences(folder_ / "first", folder_ / "second"), ::testing::IsEmpty());
  const anatomy::Specimen specimen = anatomy::load_specimen(folder_ / "second");
  EXPECT_EQ(specimen.bones.size(), 2u);
  EXPECT_EQ(specimen.joints.at(0).type, anatomy::JointType::Weld);
}

TEST_F(UnknownSpecimen, TakesWhatWasEdited) {
  const std::string scan = boxes_and_rod();
  ASSERT_EQ(run(scan + " --bones Segment_1,Segment_2 --write-recipe " + path("r.json")), kDone) << error_;
  EXPECT_FALSE(fs::exists(folder_ / "first"));
  nlohmann::json recipe = nlohmann::json::parse(read_file(path("r.json")));
  recipe["joints"][0]["type"] = "hinge";
  recipe["joints"][0]["axes"] = {{0.0, -1.0, 0.0}};
  recipe["joints"][0]["centre_m"] = {0.05, 0.0, -0.02};
  recipe["joints"][0]["range_rad"] = {{-0.2, 1.7}};
  recipe["muscles"][0]["peak_force_N"] = 123.0;
  std::ofstream(path("r.json")) << recipe.dump();
  ASSERT_EQ(run(scan + " -o " + path("edited") + " --recipe " + path("r.json")), kDone) << error_;
  const anatomy::Specimen specimen = anatomy::load_specimen(folder_ / "edited");
  EXPECT_EQ(specimen.joints.at(0).type, anatomy::JointType::Hinge);
  EXPECT_EQ(specimen.muscles.at(0).peak_force_N, 123.0);
  EXPECT_EQ(read_file(folder_ / "edited" / "recipe.json"), recipe.dump());  // not lost
}

TEST_F(UnknownSpecimen, IsASingleMuscleToo) {
  put("Segment_3", testing::rod_surface({}));
  ASSERT_EQ(run(path("scan/Segment_3.ply") + " --json -o " + path("lone")), kDone) << error_;
  const anatomy::Specimen specimen = anatomy::load_specimen(folder_ / "lone");
  EXPECT_TRUE(specimen.bones.empty());
  EXPECT_TRUE(specimen.joints.empty());
  ASSERT_EQ(specimen.muscles.size(), 1u);
  int held = 0;
  for (const int body : specimen.muscles[0].attachments) held += body == 0 ? 1 : 0;
  EXPECT_GE(held, 8);
  EXPECT_THAT(output_, HasSubstr(R"({"decide":"parts","part":"segment_3")"));
  EXPECT_EQ(run("check " + path("lone")), kDone) << output_;
}

TEST_F(UnknownSpecimen, NeverWaitsForAPersonWhoIsNotThere) {
  ASSERT_EQ(run(boxes_and_rod() + " --ask --write-recipe " + path("r.json")), kDone) << error_;
  EXPECT_THAT(error_, HasSubstr("no terminal"));
  EXPECT_TRUE(fs::exists(path("r.json")));
}

TEST_F(UnknownSpecimen, IsRefusedWithNothingLeftBehind) {
  const std::string scan = boxes_and_rod();
  const auto refused = [&](const std::string& arguments, ExitStatus status, const std::string& text) {
    EXPECT_EQ(run(arguments), static_cast<int>(status)) << error_;
    EXPECT_THAT(error_, HasSubstr(text));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  };
  const std::string out = " -o " + path("out");
  refused(scan + out + " --bones Segment_4", ExitStatus::Usage, "Segment_");
  refused(scan + out + " --units in", ExitStatus::BadData, "--units");
  refused(scan + out + " --bones Segment_1 --recipe " + path("r.json"), ExitStatus::Usage, "--bones");
  std::ofstream(path("scan/joint x.mrk.json")) << R"({"markups": [{"type": "Line", "controlPoints": []}]})";
  refused(scan + out + " --guess", ExitStatus::BadData, "joint x.mrk.json");
  std::ofstream(path("scan/Segment_1.ply")) << "no surface";
  refused(scan + out + " --guess", ExitStatus::BadData, "Segment_1.ply");
}

/// Volume and middle [mm] of a part's skin.
struct Bulk {
  double volume_mm3 = 0.0;
  Vec3 middle_mm = Vec3::Zero();
};

Bulk bulk_of(const geometry::TriangleMesh& skin) {
  Bulk bulk;
  for (const auto& [a, b, c] : skin.triangles) {
    const auto corner = [&](int i) { return Vec3(1e3 * skin.positions_m[static_cast<std::size_t>(i)]); };
    const double volume_mm3 = corner(a).dot(corner(b).cross(corner(c))) / 6.0;
    bulk.volume_mm3 += volume_mm3;
    bulk.middle_mm += 0.25 * volume_mm3 * (corner(a) + corner(b) + corner(c));
  }
  bulk.middle_mm /= bulk.volume_mm3;
  return bulk;
}

/// Of the specimen's parts by key.
std::map<std::string, Bulk> bulks_of(const anatomy::Specimen& specimen) {
  std::map<std::string, Bulk> bulks;
  for (const anatomy::Bone& bone : specimen.bones) bulks[bone.key] = bulk_of(bone.surface);
  for (const anatomy::Muscle& muscle : specimen.muscles) bulks[muscle.key] = bulk_of(muscle.skin);
  return bulks;
}

/// Specimen frame, from LPS: superior is cranial, left is left, posterior is up.
Vec3 in_specimen(const Vec3& lps) {
  return {lps.z(), lps.x(), lps.y()};
}

double voxels_mm3(const testing::PhantomGrid& grid, int label) {
  const std::vector<int> labels = testing::phantom_labels(grid);
  return std::abs(grid.steps_mm.determinant()) * static_cast<double>(std::count(labels.begin(), labels.end(), label));
}

using PhantomFiles = std::vector<std::tuple<std::string, testing::PhantomGrid, std::string>>;  // name, grid, bytes

TEST_F(UnknownSpecimen, IsTheSameFromEveryFormatAndOrderOfAxesOfAVolume) {
  const std::vector<testing::PhantomGrid> grids = testing::all_orientations({});
  const PhantomFiles files{
      {"a.nrrd", grids[0], testing::nrrd_file(grids[0])},
      {"b.nii.gz", grids[13], testing::gzip(testing::nifti_file(grids[13], 1, testing::NiftiPlaces::Quaternion))},
      {"c.nii", grids[22], testing::nifti_file(grids[22], 2, testing::NiftiPlaces::Affine)},
      {"d.mha", grids[41], testing::meta_image_file(grids[41], {2, true, true}, true)},
      {"e.nrrd", testing::oblique_grid(),
       testing::nrrd_file(testing::oblique_grid(), "right-anterior-superior", Vec3(-1, -1, 1))}};
  std::map<int, double> first;  // share of its voxels, by label
  for (const auto& [name, grid, bytes] : files) {
    write_file(folder_ / name, bytes);
    ASSERT_EQ(run(path(name) + " --guess --bones 'label 3' -o " + path(name + "_limb")), kDone) << name << error_;
    const anatomy::Specimen specimen = anatomy::load_specimen(folder_ / (name + "_limb"));
    EXPECT_EQ(specimen.bones.size(), 1u);
    EXPECT_EQ(specimen.muscles.size(), 4u);
    const std::map<std::string, Bulk> bulks = bulks_of(specimen);
    const auto expect_ball = [&](int label, const Vec3& middle_mm) {
      const Bulk& bulk = bulks.at("label_" + std::to_string(label));
      const double share = bulk.volume_mm3 / voxels_mm3(grid, label);
      // Smoothing takes an eighth of a ball of three voxels' radius, whichever way it was stored.
      EXPECT_NEAR(share, 0.93, 0.07) << name << label;
      EXPECT_NEAR(share, first.try_emplace(label, share).first->second, name == "e.nrrd" ? 0.07 : 0.02)
          << name << label;
      EXPECT_LT((bulk.middle_mm - in_specimen(middle_mm)).norm(), 0.6) << name << label;
    };
    expect_ball(testing::kSphere, {12, 11, 12});
    expect_ball(testing::kSmallSphere, {12, 26, 12});
    EXPECT_LT((in_specimen({29, 20, 0}) - bulks.at("label_3").middle_mm).tail<2>().norm(), 0.5) << name;
    EXPECT_NEAR(bulks.at("label_5").middle_mm.x(), 35.8, 0.6) << name;
  }
}

TEST_F(UnknownSpecimen, TakesWhatWasMarkedOnAVolume) {
  write_file(folder_ / "p.nrrd", testing::nrrd_file({}));
  write_file(folder_ / "joint knee label_1 label_3.mrk.json",
             R"({"markups": [{"type": "Line", "coordinateSystem": "RAS", "coordinateUnits": "mm", "controlPoints": [
                {"label": "L-1", "position": [-20, -10, 12]}, {"label": "L-2", "position": [-20, -26, 12]}]}]})");
  const std::string volume = path("p.nrrd") + " '" + path("joint knee label_1 label_3.mrk.json") + "'";
  ASSERT_EQ(run(volume + " --guess --bones 'label 1,label 3' -o " + path("limb")), kDone) << error_;
  const anatomy::Specimen specimen = anatomy::load_specimen(folder_ / "limb");
  ASSERT_EQ(specimen.joints.size(), 1u);
  EXPECT_EQ(specimen.joints[0].type, anatomy::JointType::Hinge);
  // A right-hand rotation of the second bone flexes; where that one is the parent, the first turns the other way.
  const bool second_turns = specimen.bodies[static_cast<std::size_t>(specimen.joints[0].child)].key == "label_3";
  EXPECT_LT((specimen.joints[0].axes[0] - in_specimen({0, second_turns ? 1.0 : -1.0, 0})).norm(), 1e-9);
  EXPECT_LT((1e3 * specimen.joints[0].centre_m - in_specimen({20, 18, 12})).norm(), 1e-6);
  EXPECT_EQ(run(path("p.nrrd") + " " + boxes_and_rod() + " --guess -o " + path("out")),
            static_cast<int>(ExitStatus::Usage));
  EXPECT_THAT(error_, HasSubstr("nothing but Markups"));
}

}  // namespace
}  // namespace myotact::prepare
