// The program as its users run it: files left, repeatable bytes, replay, interruption.

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"

namespace myotact::testing {
namespace {

using ::testing::HasSubstr;

std::string content(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string at(const TemporaryFolder& folder, const std::string& name) {
  return (folder.path() / name).string();
}

/// The table of 1.2 s of the elbow's script, a row a millisecond.
void expect_touch_in_table(const std::string& csv) {
  std::istringstream table(csv);
  std::string line;
  std::getline(table, line);
  EXPECT_THAT(line, HasSubstr("t_s,tool_x_m"));
  EXPECT_THAT(line, HasSubstr("elbow_K_Nm_rad,a_biceps_brachii"));
  int rows = 0, touching = 0;
  while (std::getline(table, line)) {
    ++rows;
    std::istringstream fields(line);
    std::string field;
    for (int i = 0; i < 12; ++i) std::getline(fields, field, ',');
    touching += field == "1" ? 1 : 0;
  }
  EXPECT_EQ(rows, 1200);
  EXPECT_GT(touching, 100);
}

void expect_touch_in_summary(const std::filesystem::path& out) {
  const auto summary = nlohmann::json::parse(content(out / "summary.json"));
  EXPECT_GT(summary.at("largest_force_N"), 0.2) << out;
  EXPECT_GT(summary.at("contact_s"), 0.1) << out;
  const double wall_s = summary.at("wall_s");  // on a busy machine 1.2 simulated seconds last longer
  EXPECT_LT(summary.at("contact_s"), std::max(1.2, wall_s)) << out;
  EXPECT_GT(summary.at("largest_drift_deg"), 0.01) << out;
}

TEST(Run, ATouchIsFeltInTheSameBytesTwiceAndWithOneAndTwoWorkers) {
  TemporaryFolder folder;
  const std::string common = "run elbow --seconds 1.2 --out ";
  const std::string record = " --workers 2 --levels 0 --record " + at(folder, "a.rec");
  ASSERT_EQ(run_program(common + at(folder, "a") + record).status, 0);
  ASSERT_EQ(run_program(common + at(folder, "b") + " --workers 2 --levels none").status, 0);
  ASSERT_EQ(run_program(common + at(folder, "c") + " --workers 1 --levels none", "LC_ALL=de_DE.UTF-8").status, 0);
  const std::string first = content(folder.path() / "a" / "samples.csv");
  EXPECT_GT(first.size(), 100'000u);
  EXPECT_EQ(first, content(folder.path() / "b" / "samples.csv"));
  EXPECT_EQ(first, content(folder.path() / "c" / "samples.csv"));
  for (const char* file : {"summary.json", "stiffness.csv", "stiffness.svg"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "a" / file)) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b" / "stiffness.csv")) << "no table was asked for";
  expect_touch_in_table(first);
  expect_touch_in_summary(folder.path() / "a");
  const Outcome replayed = run_program("replay --json " + at(folder, "a.rec"));
  EXPECT_EQ(replayed.status, 0) << replayed.output;
  EXPECT_THAT(replayed.output, HasSubstr("\"equal\": true"));
}

TEST(Run, ATouchIsFeltOnTheWallClock) {
  TemporaryFolder folder;
  ASSERT_EQ(run_program("run elbow --levels none --seconds 1.2 --realtime --out " + at(folder, "out")).status, 0);
  expect_touch_in_summary(folder.path() / "out");
}

TEST(Run, TwoHandsOnEitherClockAreFeltAgain) {
  for (const char* clock : {"", " --realtime"}) {
    TemporaryFolder folder;
    const std::string run = "run bimanual --set tissue.default=line --device simulated,simulated --seconds 3.5" +
                            std::string(clock) + " --out " + at(folder, "out") + " --record " + at(folder, "two.rec");
    const Outcome outcome = run_program(run);
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const auto summary = nlohmann::json::parse(content(folder.path() / "out" / "summary.json"));
    EXPECT_GT(summary.at("left").at("bone_in_hand_s"), 0.5) << run;
    EXPECT_GT(summary.at("right").at("largest_force_N"), 0.1) << run;
    EXPECT_EQ(summary.at("right").at("bone_in_hand_s"), 0.0) << run;
    const Outcome replayed = run_program("replay --json " + at(folder, "two.rec"));
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_THAT(replayed.output, HasSubstr("\"left_largest_force_difference_N\": 0.0"));
    EXPECT_THAT(replayed.output, HasSubstr("\"right_largest_force_difference_N\": 0.0"));
  }
}

TEST(Run, StiffnessOfMassSpringMusclesIsMarkedAsAPreview) {
  for (const bool springs : {true, false}) {
    TemporaryFolder folder;
    const std::string tissue = springs ? " --set 'tissue={\"default\": \"mass_spring\"}'" : "";
    const Outcome outcome = run_program("run elbow --levels 0 --seconds 0.05" + tissue + " --out " + at(folder, "out"));
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const auto summary = nlohmann::json::parse(content(folder.path() / "out" / "summary.json"));
    EXPECT_EQ(summary.at("stiffness").at(0).contains("mark"), springs);
    EXPECT_EQ(outcome.output.find("preview (mass-spring)") != std::string::npos, springs);
    const std::string chart = content(folder.path() / "out" / "stiffness.svg");
    EXPECT_EQ(chart.find("preview (mass-spring)") != std::string::npos, springs);
  }
}

TEST(Run, InterruptedRunStillLeavesItsTables) {
  TemporaryFolder folder;
  const Outcome outcome =
      run_program("run elbow --set tissue.default=line --seconds 3600 --out " + at(folder, "out"), "timeout -s INT 4");
  EXPECT_EQ(outcome.status, 124);  // timeout's own status; the program's files tell how it ended
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / "samples.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / "summary.json"));
}

// The watchdog is a child of the program. Killed, the program cannot say goodbye to it.
TEST(Run, AKilledProgramLeavesNoWatchdogBehind) {
  TemporaryFolder folder;
  const Outcome outcome =
      run_program("run elbow --set tissue.default=line --realtime --seconds 60 --out " + at(folder, "out") +
                  " & P=$!; sleep 3; W=$(ps -o pid= --ppid $P); kill -9 $P; wait $P; sleep 0.5; for w in $W; do echo "
                  "watched by $w; "
                  "if grep -qs 'State:.[^Z]' /proc/$w/status; then echo left behind; fi; done");
  EXPECT_THAT(outcome.output, HasSubstr("watched by"));
  EXPECT_THAT(outcome.output, ::testing::Not(HasSubstr("left behind")));
}

}  // namespace
}  // namespace myotact::testing
