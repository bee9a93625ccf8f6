#include "learn/lesson_results.h"

#include <clocale>

#include <gtest/gtest.h>

#include "learn/elbow.h"

namespace myotact::learn {
namespace {

using testing::elbow;
using testing::lesson_of;

TEST(LessonResults, OneRowATaskQuotedAsSpreadsheetsReadIt) {
  const Lesson lesson = lesson_of(R"("task": {"kind": "name", "part": "biceps_brachii"}, "hints": ["h"])");
  LessonRun run(lesson, elbow(), testing::facts());
  const messages::SceneFrame frame;
  run.observe({elbow(), frame, 10.0, {}});
  run.observe({elbow(), frame, 12.345, {}});
  run.type("a \"b\", c");
  const std::string head = "lesson,step,task,answer,right,attempts,hints,seconds,score\n";
  EXPECT_EQ(results_csv(run), head + "l,1,name,\"a \"\"b\"\", c\",0,1,0,2.35,0\n");
  run.ask_hint();
  run.type("=1+1");
  EXPECT_EQ(results_csv(run), head + "l,1,name,'=1+1,0,2,1,2.35,0\n") << "no formula";
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr) {
    EXPECT_EQ(results_csv(run), head + "l,1,name,'=1+1,0,2,1,2.35,0\n");
    std::setlocale(LC_ALL, "C");
  }
}

TEST(LessonResults, ReadingIsNoRow) {
  const Lesson lesson = lesson_of(R"("points": 0)");
  const LessonRun run(lesson, elbow(), testing::facts());
  EXPECT_EQ(results_csv(run), "lesson,step,task,answer,right,attempts,hints,seconds,score\n");
}

TEST(LessonResults, FileNamesAreSafe) {
  EXPECT_EQ(results_file_name("Ada Lovelace", "quiz"), "Ada_Lovelace_quiz.csv");
  EXPECT_EQ(results_file_name("../../etc/x", "quiz"), "______etc_x_quiz.csv");
  EXPECT_EQ(results_file_name("J\xc3\xb6rg", "quiz"), "J\xc3\xb6rg_quiz.csv");
  EXPECT_EQ(results_file_name(" ./ ", "quiz"), "");
  EXPECT_EQ(results_file_name("", "quiz"), "");
  EXPECT_LT(results_file_name(std::string(500, 'a'), "quiz").size(), 100u);
}

}  // namespace
}  // namespace myotact::learn
