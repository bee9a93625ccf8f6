#include "learn/lesson_run.h"

#include <gtest/gtest.h>

#include "learn/elbow.h"

namespace myotact::learn {
namespace {

using testing::elbow;
using testing::lesson_of;

constexpr int kBiceps = 0, kBrachialis = 1;

/// A scene as the simulation would publish it, and the student before it.
class Class {
 public:
  explicit Class(const std::string& members) : lesson(lesson_of(members)), run(lesson, elbow(), testing::facts()) {
    frame.joints.resize(elbow().joints.size());
    for (auto& joint : frame.joints) joint.muscles.resize(elbow().muscles.size());
    frame.tools.resize(1);
  }

  /// Pictures of 10 ms.
  void pass(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i) {
      frame.time_s += 0.01;
      clock_s += 0.01;
      run.observe({elbow(), frame, clock_s, selected});
    }
  }
  void touch(int muscle, double force_N = 0.0) {
    frame.tools[0].in_contact = muscle >= 0;
    frame.tools[0].touched_muscle = muscle;
    frame.tools[0].force_world_N = {0.0, 0.6 * force_N, -0.8 * force_N};
  }
  messages::JointFrame& joint() { return frame.joints[1]; }  // the elbow

  Lesson lesson;
  LessonRun run;
  messages::SceneFrame frame;
  double clock_s = 100.0;
  Part selected;
};

TEST(LessonRun, FindTakesClicksAndTellsWrongOnes) {
  Class c(R"("task": {"kind": "find", "part": "brachialis"}, "points": 4)");
  c.selected = {kBrachialis, -1};  // from before the lesson: no answer
  c.pass(0.5);
  EXPECT_EQ(c.run.state().attempts, 0);
  c.selected = {kBiceps, -1};
  c.pass(0.5);
  EXPECT_EQ(c.run.state().feedback, Feedback::Wrong);
  EXPECT_EQ(c.run.state().answer, "biceps_brachii");
  EXPECT_EQ(c.run.state().attempts, 1) << "a click is one answer, however long it stays";
  c.selected = {};
  c.pass(0.1);
  EXPECT_EQ(c.run.state().attempts, 1);
  c.selected = {kBrachialis, -1};
  c.pass(0.1);
  EXPECT_TRUE(c.run.state().right);
  EXPECT_DOUBLE_EQ(c.run.score(), 2.0) << "a wrong answer takes half";
  EXPECT_NEAR(c.run.state().seconds, 1.09, 0.011) << "until it was done";
}

TEST(LessonRun, HintsTakeAQuarterEachAndNoneIsLeftAfterTheLast) {
  Class c(R"("task": {"kind": "find", "part": "ulna"}, "hints": ["a", "b"])");
  for (int i = 0; i < 5; ++i) c.run.ask_hint();
  EXPECT_EQ(c.run.state().hints, 2);
  c.pass(0.1);
  c.selected = {-1, 3};
  c.pass(0.1);
  EXPECT_DOUBLE_EQ(c.run.score(), 0.5);
  c.run.ask_hint();
  EXPECT_DOUBLE_EQ(c.run.score(), 0.5) << "what is done stays";
}

TEST(LessonRun, PointsNeverGoBelowNone) {
  Step step;
  step.points = 2.0;
  step.task = FindTask{};
  TaskState state;
  state.right = true;
  state.wrong = 3;
  state.hints = 2;
  EXPECT_EQ(points_of(step, state), 0.0);
  EXPECT_EQ(points_of(step, TaskState{}), 0.0);
}

TEST(LessonRun, TouchWantsTheMuscleItselfForAMoment) {
  Class c(R"("task": {"kind": "touch", "part": "brachialis"})");
  c.touch(kBiceps);
  c.pass(1.0);
  c.touch(kBrachialis);
  c.pass(0.2);
  c.touch(-1);
  c.pass(0.1);
  EXPECT_FALSE(c.run.state().done);
  c.touch(kBrachialis);
  c.pass(0.35);
  EXPECT_TRUE(c.run.state().right);
}

TEST(LessonRun, TouchOfABoneIsThatOfItsBody) {
  Class c(R"("task": {"kind": "touch", "part": "humerus"})");
  c.frame.tools[0].in_contact = true;
  c.frame.tools[0].touched_body = elbow().bones[2].body;
  c.pass(0.5);
  EXPECT_FALSE(c.run.state().done);
  c.frame.tools[0].touched_body = elbow().bones[1].body;
  c.pass(0.5);
  EXPECT_TRUE(c.run.state().right);
}

TEST(LessonRun, PressWantsTheForceInTheBandForTheTime) {
  Class c(R"("task": {"kind": "press", "muscle": "brachialis", "band_N": [0.5, 1.0], "hold_s": 1})");
  c.touch(kBrachialis, 1.5);
  c.pass(2.0);
  EXPECT_DOUBLE_EQ(c.run.state().force_N, 1.5);
  EXPECT_EQ(c.run.state().held_s, 0.0);
  c.touch(kBrachialis, 0.75);
  c.pass(0.8);
  EXPECT_NEAR(c.run.state().held_s, 0.8, 1e-9);
  c.touch(kBrachialis, 0.2);
  c.pass(0.1);
  EXPECT_NEAR(c.run.state().held_s, 0.6, 1e-9) << "a slip counts back twice";
  c.touch(kBiceps, 0.75);
  c.pass(0.1);
  c.touch(kBrachialis, 0.75);
  c.pass(0.55);
  EXPECT_FALSE(c.run.state().done);
  c.pass(0.1);
  EXPECT_TRUE(c.run.state().right);
  EXPECT_EQ(c.run.state().answer, "0.75");
}

TEST(LessonRun, APausedSceneHoldsNothing) {
  Class c(R"("task": {"kind": "press", "muscle": "brachialis", "band_N": [0.5, 1.0]})");
  c.touch(kBrachialis, 0.75);
  for (int i = 0; i < 1000; ++i) c.run.observe({elbow(), c.frame, c.clock_s, {}});
  EXPECT_EQ(c.run.state().held_s, 0.0);
}

const char* const kPredict =
    R"("task": {"kind": "predict", "muscle": "biceps_brachii", "joint": "elbow", "motion": "flexion"})";

TEST(LessonRun, APredictionIsJudgedByThePullThatFollows) {
  for (const Motion guess : {Motion::Flexion, Motion::Extension}) {
    Class c(kPredict);
    c.joint().muscles[kBiceps].moment_arm_m = 0.0113;
    c.joint().angle_rad = 0.2;
    c.frame.tools[0].grabbed_line = kBiceps;  // pulling before predicting shows nothing
    c.pass(0.1);
    c.joint().angle_rad = 0.3;
    c.pass(0.1);
    EXPECT_FALSE(c.run.state().done);
    c.frame.tools[0].grabbed_line = -1;
    c.run.predict(guess);
    c.run.predict(Motion::Flexion);  // no second thoughts
    EXPECT_EQ(c.run.state().feedback, Feedback::PullNow);
    c.pass(0.1);
    c.frame.tools[0].grabbed_line = kBiceps;
    c.pass(0.1);
    c.joint().angle_rad = 0.303;
    c.pass(0.1);
    EXPECT_FALSE(c.run.state().done) << "less than a fifth of a degree";
    c.joint().angle_rad = 0.31;
    c.pass(0.1);
    EXPECT_TRUE(c.run.state().done);
    EXPECT_EQ(c.run.state().right, guess == Motion::Flexion);
    EXPECT_DOUBLE_EQ(c.run.score(), guess == Motion::Flexion ? 1.0 : 0.5);
    EXPECT_DOUBLE_EQ(c.run.state().moment_arm_m, 0.0113);
  }
}

TEST(LessonRun, StiffenWantsStiffnessAtTheSameAngle) {
  Class c(R"("task": {"kind": "stiffen", "joint": "elbow", "factor": 3, "within_rad": 0.02, "hold_s": 1})");
  c.joint().stiffness_Nm_rad = 1.5;
  c.joint().angle_rad = 0.1;
  c.pass(1.0);
  EXPECT_DOUBLE_EQ(c.run.state().lowest_Nm_rad, 1.5);
  c.joint().stiffness_Nm_rad = 4.6;
  c.joint().angle_rad = 0.15;  // one side won
  c.pass(2.0);
  EXPECT_FALSE(c.run.state().done);
  c.joint().angle_rad = 0.11;
  c.joint().stiffness_Nm_rad = 4.4;
  c.pass(2.0);
  EXPECT_FALSE(c.run.state().done);
  c.joint().stiffness_Nm_rad = 4.6;
  c.pass(1.1);
  EXPECT_TRUE(c.run.state().right);
  EXPECT_EQ(c.run.state().answer, "4.6");
}

TEST(LessonRun, AnUnstableJointIsComparedWithItsOwnSpring) {
  Class c(R"("task": {"kind": "stiffen", "joint": "elbow", "factor": 2})");
  c.joint().stiffness_Nm_rad = -6.5;
  c.joint().passive_Nm_rad = 0.1;
  c.pass(1.0);
  EXPECT_DOUBLE_EQ(c.run.state().lowest_Nm_rad, 0.1);
}

TEST(LessonRun, IdentifyWantsTheTouchBeforeTheName) {
  Class c(R"("task": {"kind": "identify", "part": "brachialis", "options": ["biceps_brachii", "brachialis"]})");
  c.run.choose(1);
  EXPECT_EQ(c.run.state().feedback, Feedback::TouchFirst);
  EXPECT_EQ(c.run.state().attempts, 0);
  c.touch(kBrachialis);
  c.pass(0.5);
  EXPECT_TRUE(c.run.state().touched);
  c.run.choose(7);
  EXPECT_EQ(c.run.state().attempts, 0);
  c.run.choose(0);
  EXPECT_EQ(c.run.state().feedback, Feedback::Wrong);
  c.run.choose(1);
  EXPECT_TRUE(c.run.state().right);
  EXPECT_DOUBLE_EQ(c.run.score(), 0.5);
}

TEST(LessonRun, NamesAreChosenOrTyped) {
  Class chosen(R"("task": {"kind": "name", "part": "ulna", "options": ["radius", "ulna"]})");
  chosen.run.choose(1);
  EXPECT_TRUE(chosen.run.state().right);
  Class typed(R"("task": {"kind": "name", "part": "biceps_brachii"})");
  typed.run.type("brachialis");
  typed.run.type("M. biceps brachii");
  EXPECT_TRUE(typed.run.state().right);
  EXPECT_EQ(typed.run.state().wrong, 1);
}

TEST(LessonRun, LeftOutStepsEarnNothingAndGoingBackKeepsAnswers) {
  const std::string steps = R"({"schema": 1, "key": "l", "title": "T", "scene": "elbow", "steps": [
    {"title": "a", "text": "x"},
    {"title": "b", "text": "x", "task": {"kind": "name", "part": "ulna", "options": ["radius", "ulna"]}},
    {"title": "c", "text": "x", "task": {"kind": "find", "part": "ulna"}}]})";
  const Lesson lesson = parse_lesson(steps, "l.json", elbow());
  EXPECT_EQ(most_points(lesson), 2.0);
  LessonRun run(lesson, elbow(), testing::facts());
  run.go_back();
  EXPECT_EQ(run.index(), 0u);
  run.go_on();
  run.choose(1);
  run.go_on();
  run.go_on();
  EXPECT_TRUE(run.finished());
  EXPECT_DOUBLE_EQ(run.score(), 1.0);
  EXPECT_FALSE(run.states()[2].right);
  run.go_back();
  EXPECT_FALSE(run.finished());
  run.go_back();
  EXPECT_EQ(run.index(), 1u);
  run.choose(0);
  EXPECT_TRUE(run.state().right);
}

}  // namespace
}  // namespace myotact::learn
