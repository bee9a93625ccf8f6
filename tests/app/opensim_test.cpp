// Models of OpenSim from the command line: out, in, and on; or a sentence and nothing.

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "core/file.h"

namespace myotact::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kBadData = 65, kNoInput = 66, kUsage = 2;

TEST(OpenSimProgram, ALimbGoesOutAndComesBackAndIsMeasured) {
  const TemporaryFolder folder;
  const std::string model = (folder.path() / "limb.osim").string(), specimen = (folder.path() / "limb").string();
  ASSERT_EQ(run_program("export elbow -o " + model).status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "limb_geometry"));
  const Outcome import = run_program("import " + model + " --json --log-level error --out " + specimen);
  ASSERT_EQ(import.status, 0) << import.output;
  const auto told = nlohmann::json::parse(import.output);
  EXPECT_EQ(told["scene_joint"], "elbow");
  EXPECT_EQ(told["not_taken"].size(), 0u);
  const Outcome stiffness =
      run_program("stiffness " + specimen + "/scene.json --angles 20 --levels 0.5 --out " + specimen + "_out");
  EXPECT_EQ(stiffness.status, 0) << stiffness.output;
}

TEST(OpenSimProgram, BadModelsAreRefusedAndLeaveNothing) {
  const TemporaryFolder folder;
  const std::string model = (folder.path() / "old.osim").string(), out = " --out " + (folder.path() / "x").string();
  std::ofstream(model) << "<OpenSimDocument Version=\"30000\"><Model/></OpenSimDocument>";
  const Outcome old = run_program("import " + model + out);
  EXPECT_EQ(old.status, kBadData);
  EXPECT_THAT(old.output, AllOf(HasSubstr("old.osim: line 1: Version is"), HasSubstr("OpenSim 4")));
  EXPECT_EQ(run_program("import " + model + "x" + out).status, kNoInput);
  EXPECT_EQ(run_program("import " + model).status, kUsage);  // no folder
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x"));
}

}  // namespace
}  // namespace myotact::testing
