#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/program.h"

// Lessons played by a scripted student in the simulation itself.

namespace myotact::testing {
namespace {

std::filesystem::path write_text(const TemporaryFolder& folder, const char* name, const std::string& text) {
  std::ofstream(folder.path() / name) << text;
  return folder.path() / name;
}

std::string quiz(const std::string& steps) {
  return R"({"schema": 1, "key": "quiz", "title": "T", "scene": "elbow", "steps": [)" + steps + "]}";
}

/// Rows of the results by step, each split at its commas.
std::map<std::string, std::vector<std::string>> rows_of(const std::string& csv) {
  std::map<std::string, std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream row(line);
    for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
    if (fields.size() == 9) rows[fields[1]] = fields;
  }
  return rows;
}

TEST(LessonPlayed, WrongAnswersAndHintsCostWhatTheREADMESays) {
  const TemporaryFolder folder;
  const auto lesson = write_text(folder, "quiz.json", quiz(R"(
    {"title": "a", "text": "t"},
    {"title": "b", "text": "t", "task": {"kind": "find", "part": "brachialis"}, "hints": ["h"]},
    {"title": "c", "text": "t", "task": {"kind": "touch", "part": "triceps_brachii_long"}, "points": 2},
    {"title": "d", "text": "t", "task": {"kind": "name", "part": "ulna"}},
    {"title": "e", "text": "t", "task": {"kind": "find", "part": "ulna"}},
    {"title": "f", "text": "t", "task": {"kind": "press", "muscle": "triceps_brachii_long", "band_N": [0.4, 0.9]}})"));
  const auto answers = write_text(folder, "a.json", R"({"schema": 1, "answers": {
    "2": ["biceps_brachii", "hint", "brachialis"], "3": ["biceps_brachii", "triceps_brachii_long"], "4": ["Ulna"],
    "5": ["skip"], "6": ["2"]}})");
  const Outcome outcome = run_program("lesson " + lesson.string() + " --answers " + answers.string() + " 2>/dev/null");
  EXPECT_EQ(outcome.status, 0);
  auto rows = rows_of(outcome.output);
  const auto field = [&](const char* step, std::size_t column) { return rows[step].at(column); };
  EXPECT_EQ(rows.count("1"), 0u);
  EXPECT_EQ(field("2", 3), "brachialis");
  EXPECT_EQ(field("2", 4), "1");
  EXPECT_EQ(field("2", 5), "2");
  EXPECT_EQ(field("2", 6), "1");
  EXPECT_EQ(field("2", 8), "0.25") << "half for the wrong answer, a quarter for the hint";
  EXPECT_EQ(field("3", 8), "2") << "who feels his way has given no wrong answer";
  EXPECT_EQ(field("4", 4), "1");
  EXPECT_EQ(field("5", 4), "0");
  EXPECT_EQ(field("5", 5), "0");
  EXPECT_EQ(field("6", 4), "0") << "2 N is out of the band";
  EXPECT_EQ(field("6", 8), "0");
}

class ShippedLesson : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedLesson, RunsToItsEndAndRightAnswersScoreFull) {
  const Outcome outcome = run_program(std::string("lesson --auto ") + GetParam());
  EXPECT_EQ(outcome.status, 0) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(All, ShippedLesson,
                         ::testing::Values("1_find_and_touch", "2_pull_a_line", "3_co_contraction", "4_stifle",
                                           "5_hock", "6_shoulder", "7_forearm", "8_thigh_layers", "9_leg",
                                           "10_two_joints", "11_gait", "12_palpation"));

TEST(LessonPlayed, AWrongPredictionIsTaughtByThePull) {
  const TemporaryFolder folder;
  const auto lesson =
      write_text(folder, "quiz.json", quiz(R"({"title": "a", "text": "t", "set": {"hold_posture": false},
    "task": {"kind": "predict", "muscle": "biceps_brachii", "joint": "elbow", "motion": "flexion"}})"));
  const auto answers = write_text(folder, "a.json", R"({"schema": 1, "answers": {"1": ["extension"]}})");
  const Outcome outcome = run_program("lesson " + lesson.string() + " --answers " + answers.string() + " 2>/dev/null");
  const auto rows = rows_of(outcome.output);
  EXPECT_EQ(rows.at("1")[3], "extension");
  EXPECT_EQ(rows.at("1")[4], "0");
  EXPECT_EQ(rows.at("1")[8], "0.5");
}

}  // namespace
}  // namespace myotact::testing
