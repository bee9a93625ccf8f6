// The probe as a user meets it: files in, table out, one message for what is wrong.

#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"

namespace myotact::testing {
namespace {

using ::testing::HasSubstr;

/// A square of 40 mm in z = 0.
constexpr const char* kSquare =
    "OFF\n4 2 0\n-0.02 -0.02 0\n0.02 -0.02 0\n0.02 0.02 0\n-0.02 0.02 0\n3 0 1 2\n3 0 2 3\n";

class ProbeProgram : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    const auto path = folder_.path() / name;
    std::ofstream(path) << text;
    return path.string();
  }
  std::string arguments(const std::string& path_text) {
    return "probe " + file("square.off", kSquare) + " --path " + file("path.csv", path_text) + " --out " +
           (folder_.path() / "out").string();
  }
  TemporaryFolder folder_;
};

TEST_F(ProbeProgram, WritesOneRowATickAndASummary) {
  const Outcome outcome = run_program(arguments("t_s, x_m, y_m, z_m\n0, 0, 0, 0.01\n0.1, 0, 0, 0.002\n") + " --json");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.output, HasSubstr("\"rows\": 101"));
  EXPECT_THAT(outcome.output, HasSubstr("\"inside\": 0"));
  std::ifstream table(folder_.path() / "out" / "probe.csv");
  std::string line, last;
  int lines = 0;
  for (; std::getline(table, line); ++lines) last = line;
  EXPECT_EQ(lines, 102);
  EXPECT_THAT(last, HasSubstr(",1,0,0,"));  // one contact, no rescue, outside
}

TEST_F(ProbeProgram, WrongInputEndsWithItsStatusAndLeavesNothing) {
  const std::string good = "t_s,x_m,y_m,z_m\n0,0,0,0.01\n";
  EXPECT_EQ(run_program(arguments(good) + " --radius 0.006").status, 2);
  EXPECT_EQ(run_program(arguments(good) + " --stiffness 1e9").status, 2);
  EXPECT_EQ(run_program(arguments(good) + " --mu nan").status, 2);
  EXPECT_EQ(run_program(arguments(good) + " --rate 0").status, 2);
  EXPECT_EQ(run_program(arguments(good) + " --frames /nowhere").status, 66);
  const Outcome jump = run_program(arguments(good + "0.001,0,0,3\n"));
  EXPECT_EQ(jump.status, 65);
  EXPECT_THAT(jump.output, HasSubstr("path.csv: line 3: jumps by"));
  EXPECT_EQ(run_program(arguments("")).status, 65);
  EXPECT_EQ(run_program("probe /nowhere.ply --path /nowhere.csv").status, 66);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out" / "probe.csv"));
}

}  // namespace
}  // namespace myotact::testing
