#include "view/state/scene_controls.h"

#include <gtest/gtest.h>

namespace myotact::view {
namespace {

/// A scene that says what is in force, frame after frame.
class SceneControlsTest : public ::testing::Test {
 protected:
  void hear(double now_s) {
    ++frame_.sequence;
    controls_.hear(frame_, now_s);
  }

  messages::SceneFrame frame_;
  SceneControls controls_{{}};
};

TEST_F(SceneControlsTest, ShowsWhatTheScriptDoes) {
  frame_.control.common = frame_.control.common_now = 0.3;
  hear(0.0);
  EXPECT_EQ(controls_.state().common, 0.3);
  EXPECT_TRUE(controls_.take_commands().empty());
}

TEST_F(SceneControlsTest, WhatWasAskedForShowsAtOnceAndIsPushedOnce) {
  hear(0.0);
  controls_.push(messages::CoContract{0.5, 0.1});
  EXPECT_EQ(controls_.state().drive, Drive::Balance);
  EXPECT_EQ(controls_.state().common, 0.5);
  EXPECT_EQ(controls_.take_commands().size(), 1u);
  hear(0.02);  // of a step begun before
  EXPECT_EQ(controls_.state().common, 0.5);
  EXPECT_TRUE(controls_.take_commands().empty());
  frame_.control.drive = Drive::Balance;
  frame_.control.common = 0.5;
  frame_.control.difference = 0.1;
  hear(0.04);
  frame_.control.common = 0.2;  // somebody else
  hear(0.06);
  EXPECT_EQ(controls_.state().common, 0.2);
}

TEST_F(SceneControlsTest, TwoPushesBetweenTwoFramesAddUp) {
  for (int i = 0; i < 2; ++i) controls_.push(messages::CoContract{controls_.state().common + 0.05, 0.0});
  EXPECT_EQ(controls_.state().common, 0.1);
  const auto commands = controls_.take_commands();
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(std::get<messages::CoContract>(commands[1].order).common, 0.1);
}

TEST_F(SceneControlsTest, WhatIsNotDoneIsTakenBackAfterAWhileOfFrames) {
  hear(0.0);
  controls_.push(messages::Pause{true});
  hear(5.0);  // one long step: it may not have been obeyed yet
  EXPECT_TRUE(controls_.state().paused);
  hear(5.1);
  hear(5.2);
  EXPECT_FALSE(controls_.state().paused);
}

TEST_F(SceneControlsTest, OverASlowLineAFastRowOfOldFramesTakesNothingBack) {
  hear(10.0);
  controls_.push(messages::SetGravity{true});
  controls_.push(messages::CoContract{0.4, 0.0});
  for (int i = 1; i < 45; ++i) {  // 0.9 s on its way there and back, at fifty frames a second
    hear(10.0 + 0.02 * i);
    ASSERT_TRUE(controls_.state().gravity) << i;
    ASSERT_EQ(controls_.state().common, 0.4) << i;
  }
  frame_.control.gravity = true;
  hear(10.92);
  frame_.control.gravity = false;  // somebody else, after it was done
  hear(10.94);
  EXPECT_FALSE(controls_.state().gravity);
  EXPECT_EQ(controls_.state().common, 0.4) << "still on its way";
  EXPECT_EQ(controls_.take_commands().size(), 2u) << "and asked for once";
}

TEST_F(SceneControlsTest, OfTwoThatLeadTheMusclesTheLaterOneCounts) {
  hear(0.0);
  controls_.push(messages::CoContract{0.4, 0.2});
  controls_.push(messages::HoldPosture{true});
  controls_.push(messages::SetLevels{0.7, 0.1});
  EXPECT_EQ(controls_.state().drive, Drive::Levels);
  EXPECT_EQ(controls_.state().flexors, 0.7);
  EXPECT_EQ(controls_.state().common, 0.0) << "the balance was not reached";
  EXPECT_TRUE(controls_.state().hold_posture);
  controls_.push(messages::FollowScript{});
  EXPECT_EQ(controls_.state().drive, Drive::Script);
  EXPECT_EQ(controls_.state().flexors, 0.0);
  const auto commands = controls_.take_commands();
  ASSERT_EQ(commands.size(), 4u) << "the scene hears all of them, in their order";
  EXPECT_TRUE(std::holds_alternative<messages::FollowScript>(commands[3].order));
}

TEST_F(SceneControlsTest, EachHandHasAToolOfItsOwnAndBothAreSetBack) {
  using messages::ToolShape;
  hear(0.0);
  const SceneState before = scene_state_of(controls_.state());
  controls_.push(messages::ChooseTool{0, ToolShape::Point});
  controls_.push(messages::ChooseTool{1, ToolShape::Clamp});
  controls_.push(messages::ChooseTool{1, ToolShape::Ball});
  EXPECT_EQ(controls_.state().tools, (messages::ChosenTools{ToolShape::Point, ToolShape::Ball}));
  controls_.take_commands();
  controls_.restore(before);
  const auto commands = controls_.take_commands();
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_FALSE(std::get<messages::ChooseTool>(commands[0].order).shape) << "as the scene says";
  EXPECT_EQ(std::get<messages::ChooseTool>(commands[1].order).tool, 1);
  EXPECT_EQ(scene_state_of(controls_.state()), before);
}

TEST_F(SceneControlsTest, AServerThatBeganAnewIsHeardFromItsFirstFrame) {
  for (int i = 0; i < 500; ++i) hear(0.02 * i);
  frame_.sequence = 0;
  frame_.control.paused = true;
  hear(10.1);  // its first frame has the number 1
  EXPECT_TRUE(controls_.state().paused);
}

TEST_F(SceneControlsTest, AFrameThatIsNoNewsChangesNothing) {
  frame_.control.gravity = true;
  controls_.hear(frame_, 0.0);  // sequence 0: there is none yet
  EXPECT_FALSE(controls_.state().gravity);
}

TEST_F(SceneControlsTest, OfStopAndEnableInOnePictureTheStopCounts) {
  controls_.stop_forces();
  controls_.enable_forces();
  EXPECT_EQ(controls_.take_forces_on(), false);
  controls_.enable_forces();
  controls_.stop_forces();
  EXPECT_EQ(controls_.take_forces_on(), false);
  EXPECT_EQ(controls_.take_forces_on(), std::nullopt);
}

TEST_F(SceneControlsTest, RestoresAnEarlierStateByTheOrdersThatLeadThere) {
  SceneState earlier;
  earlier.gravity = true;
  frame_.control.drive = Drive::Levels;
  frame_.control.flexors = 0.5;
  hear(0.0);
  controls_.restore(earlier);
  const auto commands = controls_.take_commands();
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_TRUE(std::holds_alternative<messages::FollowScript>(commands[0].order));
  EXPECT_TRUE(std::get<messages::SetGravity>(commands[1].order).on);
  EXPECT_TRUE(orders_between(scene_state_of(controls_.state()), earlier).empty());
}

}  // namespace
}  // namespace myotact::view
