#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"

// Lessons from the command line: checked and listed.

namespace myotact::testing {
namespace {

using ::testing::HasSubstr;

std::filesystem::path write_text(const TemporaryFolder& folder, const char* name, const std::string& text) {
  std::ofstream(folder.path() / name) << text;
  return folder.path() / name;
}

std::string quiz(const std::string& steps) {
  return R"({"schema": 1, "key": "quiz", "title": "T", "scene": "elbow", "steps": [)" + steps + "]}";
}

TEST(Lesson, CheckPrintsTheStepsOrOneSentence) {
  const Outcome good = run_program("lesson 2_pull_a_line --check");
  EXPECT_EQ(good.status, 0);
  EXPECT_THAT(good.output, HasSubstr("2 predict  Biceps brachii"));

  const TemporaryFolder folder;
  const auto wrong = write_text(folder, "quiz.json", quiz(R"({"title": "a", "text": "b",
    "task": {"kind": "find", "part": "biceps_braccii"}})"));
  const Outcome bad = run_program("lesson " + wrong.string() + " --check");
  EXPECT_EQ(bad.status, 65);
  EXPECT_THAT(bad.output, HasSubstr("quiz.json: /steps/0/task/part: the specimen has no muscle or bone "
                                    "\"biceps_braccii\"; the nearest is \"biceps_brachii\""));
  const auto cut = write_text(folder, "cut.json", "{\n  \"schema\": 1,\n  \"key");
  const Outcome broken = run_program("lesson " + cut.string() + " --check");
  EXPECT_EQ(broken.status, 65);
  EXPECT_THAT(broken.output, HasSubstr("cut.json: 3:"));
}

TEST(Lesson, AnUnknownSceneOrLessonIsNamed) {
  const TemporaryFolder folder;
  const auto lost =
      write_text(folder, "quiz.json", R"({"schema": 1, "key": "q", "title": "T", "scene": "elbows", "steps": [{}]})");
  const Outcome scene = run_program("lesson " + lost.string());
  EXPECT_EQ(scene.status, 65);
  EXPECT_THAT(scene.output, HasSubstr("quiz.json: /scene: "));
  EXPECT_THAT(scene.output, HasSubstr("elbow"));
  const Outcome name = run_program("lesson 2_pull_line");
  EXPECT_EQ(name.status, 66);
  EXPECT_THAT(name.output, HasSubstr("nearest: 2_pull_a_line"));
}

TEST(Lesson, AnswersThatAreNoneAreRefused) {
  const TemporaryFolder folder;
  const auto answers = write_text(folder, "a.json", R"({"schema": 1, "answers": {"99": ["skip"]}})");
  const Outcome outcome = run_program("lesson 2_pull_a_line --answers " + answers.string());
  EXPECT_EQ(outcome.status, 65);
  EXPECT_THAT(outcome.output, HasSubstr("/answers/99: is no step; must be a number from 1 to 6"));
}

}  // namespace
}  // namespace myotact::testing
