#include "learn/lesson_file.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "learn/elbow.h"

namespace myotact::learn {
namespace {

using testing::elbow;
using ::testing::HasSubstr;
using testing::lesson_of;
using testing::lesson_text;

/// What the reader says of a text, empty where it takes it. Every complaint names the file first.
std::string complaint_of(const std::string& text) {
  try {
    parse_lesson(text, "quiz.json", elbow());
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_TRUE(std::string(error.what()).starts_with("quiz.json: ")) << error.what();
    return error.what();
  }
  return "";
}

TEST(LessonFile, ReadsEveryTaskWithItsDefaults) {
  const Lesson lesson = lesson_of(R"("task": {"kind": "press", "muscle": "brachialis", "band_N": [0.5, 1.5]},
    "hints": ["h"], "view": "medial", "show": {"muscles": ["brachialis"], "bones": [], "faded": ["humerus"], "labels": true},
    "set": {"common": 0.5, "hold_posture": true})");
  const Step& step = lesson.steps.at(0);
  const auto& press = std::get<PressTask>(step.task);
  EXPECT_EQ(press.muscle, 1);
  EXPECT_EQ(press.low_N, 0.5);
  EXPECT_EQ(press.high_N, 1.5);
  EXPECT_EQ(press.hold_s, 1.0);
  EXPECT_EQ(step.points, 1.0);
  EXPECT_EQ(step.view, "medial");
  EXPECT_EQ(step.show.muscles, std::vector<int>{1});
  EXPECT_EQ(step.show.bones, std::vector<int>{});
  EXPECT_EQ(step.show.faded, (std::vector<Part>{{-1, 1}}));
  EXPECT_TRUE(step.show.labels);
  EXPECT_EQ(step.set.common, 0.5);
  EXPECT_EQ(step.set.gravity, std::nullopt);

  const Step predict =
      lesson_of(R"("task": {"kind": "predict", "muscle": "anconeus", "joint": "elbow", "motion": "extension"})")
          .steps[0];
  EXPECT_EQ(std::get<PredictTask>(predict.task).motion, Motion::Extension);
  EXPECT_EQ(std::get<PredictTask>(predict.task).joint, anatomy::find_joint(elbow(), "elbow"));
  const Step read = lesson_of(R"("points": 0)").steps[0];
  EXPECT_STREQ(kind_of(read.task), "read");
  EXPECT_EQ(read.points, 0.0);
}

struct Refused {
  std::string members;             // of a step
  std::vector<std::string> words;  // that the complaint holds
};

class RefusedStep : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusedStep, IsRefusedWithPlaceAndRemedy) {
  const std::string complaint = complaint_of(lesson_text(GetParam().members));
  for (const std::string& word : GetParam().words) EXPECT_THAT(complaint, HasSubstr(word));
}

INSTANTIATE_TEST_SUITE_P(
    All, RefusedStep,
    ::testing::Values(
        Refused{R"("task": {"kind": "find", "part": "bicep_brachii"})", {"/steps/0/task/part", "biceps_brachii"}},
        Refused{R"("task": {"kind": "find", "part": 7})", {"/steps/0/task/part", "is 7; must be a text"}},
        Refused{R"("task": {"kind": "find"})", {"/steps/0/task", "\"part\" is missing"}},
        Refused{R"("task": {"kind": "fnd", "part": "ulna"})", {"/steps/0/task/kind", "nearest: \"find\""}},
        Refused{R"("task": {"kind": "find", "part": "ulna", "hint": "x"})", {"/steps/0/task/hint", "unknown key"}},
        Refused{R"("task": "find")", {"/steps/0/task", "must be an object"}},
        Refused{R"("task": {"kind": "press", "muscle": "ulna", "band_N": [1, 2]})", {"muscle \"ulna\""}},
        Refused{R"("task": {"kind": "press", "muscle": "anconeus", "band_N": [2, 1]})", {"band_N", "lowest, highest"}},
        Refused{R"("task": {"kind": "press", "muscle": "anconeus", "band_N": [1, 1e300]})", {"band_N/1", "and 20"}},
        Refused{R"("task": {"kind": "press", "muscle": "anconeus", "band_N": [1]})", {"band_N", "must have 2"}},
        Refused{R"("task": {"kind": "predict", "muscle": "anconeus", "joint": "carpus", "motion": "flexion"})",
                {"/steps/0/task/joint", "elbow"}},
        Refused{R"("task": {"kind": "predict", "muscle": "anconeus", "joint": "elbow", "motion": "bend"})",
                {"/steps/0/task/motion", "flexion, extension"}},
        Refused{R"("task": {"kind": "stiffen", "joint": "elbow", "factor": 1})", {"/steps/0/task/factor", "1.1"}},
        Refused{R"("task": {"kind": "name", "part": "ulna", "options": ["ulna"]})", {"has 1 options", "2 to 12"}},
        Refused{R"("task": {"kind": "name", "part": "ulna", "options": ["radius", "humerus"]})",
                {"/steps/0/task/options", "add \"ulna\""}},
        Refused{R"("task": {"kind": "identify", "part": "ulna", "options": ["ulna", "ulna"]})", {"/options/1", "once"}},
        Refused{R"("show": {"muscles": ["humerus"]})", {"/steps/0/show/muscles/0", "no muscle \"humerus\""}},
        Refused{R"("show": {"colour": "red"})", {"/steps/0/show/colour", "kind"}},
        Refused{R"("set": {"common": 2})", {"/steps/0/set/common", "between 0 and 1"}},
        Refused{R"("set": {"flexors": 1})", {"/steps/0/set", "extensors"}},
        Refused{R"("set": {"flexors": 1, "extensors": 1, "common": 0})", {"/steps/0/set", "either"}},
        Refused{R"("view": "anterior")", {"/steps/0/view", "cranial"}}, Refused{R"("points": -1)", {"/steps/0/points"}},
        Refused{R"("points": 5)", {"reading earns no points"}},
        Refused{R"("hints": ["a", "b", "c", "d", "e"])", {"/steps/0/hints", "at most 4"}},
        Refused{R"("hints": [""])", {"/steps/0/hints/0", "is empty"}},
        Refused{R"("titel": "x")", {"/steps/0/titel", "\"title\""}}));

TEST(LessonFile, RefusesAnotherVersionBeforeItsKeys) {
  const std::string newer = complaint_of(R"({"schema": 2, "chapters": []})");
  EXPECT_THAT(newer, HasSubstr("/schema"));
  EXPECT_THAT(newer, HasSubstr("version 2"));
  EXPECT_THAT(newer, HasSubstr("newer Myotact"));
  EXPECT_THAT(complaint_of(R"({"schema": 0})"), HasSubstr("write \"schema\": 1"));
  EXPECT_THAT(complaint_of(R"({"schema": 1e300})"), HasSubstr("version"));
  EXPECT_THAT(complaint_of(R"({"schema": "1"})"), HasSubstr("must be a number"));
  EXPECT_THAT(complaint_of(R"({"key": "l"})"), HasSubstr("\"schema\" is missing"));
}

TEST(LessonFile, RefusesLessonsWithoutStepsAndBadKeys) {
  const std::string head = R"({"schema": 1, "title": "T", "scene": "elbow", )";
  EXPECT_THAT(complaint_of(head + R"("key": "l", "steps": []})"), HasSubstr("has 0 steps; must have 1 to 200"));
  EXPECT_THAT(complaint_of(head + R"("key": "l", "steps": {}})"), HasSubstr("must be a list"));
  EXPECT_THAT(complaint_of(head + R"("key": "../l", "steps": [{}]})"), HasSubstr("/key: must be 1 to 60"));
  EXPECT_THAT(complaint_of(head + R"("key": "l", "steps": [{}]})"), HasSubstr("/steps/0: the key \"title\""));
  EXPECT_THAT(complaint_of(head + R"("key": "l", "steps": [3]})"), HasSubstr("/steps/0"));
  EXPECT_THAT(complaint_of("[]"), HasSubstr("must be an object"));
}

TEST(LessonFile, EveryCutOffLessonIsRefusedWithLineAndColumn) {
  const std::string whole = lesson_text("\n\"task\": {\"kind\": \"find\", \"part\": \"ulna\"}");
  ASSERT_EQ(complaint_of(whole), "");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::string complaint = complaint_of(whole.substr(0, length));
    EXPECT_THAT(complaint, ::testing::MatchesRegex("quiz.json: [1-3]:[0-9]+: .+")) << length;
  }
}

}  // namespace
}  // namespace myotact::learn
