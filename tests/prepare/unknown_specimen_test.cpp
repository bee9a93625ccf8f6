// The program on parts that no recipe knows: a specimen, the recipe that was guessed, and the same from that recipe.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "anatomy/specimen.h"
#include "core/exit_status.h"
#include "core/file.h"
#include "geometry/mesh_files.h"
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

}  // namespace
}  // namespace myotact::prepare
