#include "view/state/history.h"

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/look/part_actions.h"
#include "view/look/start_view.h"

namespace myotact::view {
namespace {

class UndoTest : public ::testing::Test {
 protected:
  anatomy::Specimen specimen_ = myotact::testing::antagonist_hinge();
  WorkState state_{start_view(specimen_, 1.0f), {}};
  History history_{state_};
};

TEST_F(UndoTest, EveryChangeIsAStepAndADragIsOne) {
  const WorkState start = state_;
  isolate(state_.view, {PartKind::Muscle, 1});
  history_.note(state_, false);
  const WorkState isolated = state_;
  for (int i = 0; i < 5; ++i) {
    state_.scene.common = 0.1 * i;
    history_.note(state_, true);  // a slider is held
  }
  history_.note(state_, false);
  history_.note(state_, false);  // nothing new
  EXPECT_EQ(history_.undo(), isolated);
  EXPECT_EQ(history_.undo(), start);
  EXPECT_FALSE(history_.can_undo());
  EXPECT_EQ(history_.undo(), start);
  EXPECT_EQ(history_.redo(), isolated);
  EXPECT_EQ(history_.redo(), state_);
  EXPECT_FALSE(history_.can_redo());
}

TEST_F(UndoTest, ANewChangeGivesUpWhatWasUndone) {
  state_.scene.common = 0.5;
  history_.note(state_, false);
  WorkState back = history_.undo();
  back.scene.gravity = true;
  history_.note(back, false);
  EXPECT_FALSE(history_.can_redo());
  EXPECT_EQ(history_.undo().scene.common, 0.0);
}

/// The script went on between two changes of the person: undo leads back to what it had come to, not to the beginning.
TEST_F(UndoTest, AChangeBeginsFromWhatWasInForce) {
  SceneState driven = state_.scene;
  driven.hold_posture = true;
  history_.begin_from(driven);
  state_.scene = driven;
  state_.scene.gravity = true;
  history_.note(state_, false);
  EXPECT_EQ(history_.undo().scene, driven);
  EXPECT_FALSE(history_.can_undo());
}

TEST_F(UndoTest, MemoryOfStepsIsBounded) {
  for (int i = 1; i <= 2000; ++i) {
    state_.scene.common = 1e-4 * i;
    history_.note(state_, false);
  }
  int steps = 0;
  while (history_.can_undo()) {
    history_.undo();
    ++steps;
  }
  EXPECT_EQ(steps, 499);
}

TEST_F(UndoTest, IsolatingTwiceShowsEverythingAgain) {
  const Part part{PartKind::Muscle, 0};
  isolate(state_.view, part);
  EXPECT_TRUE(is_isolated(state_.view, part));
  EXPECT_TRUE(state_.view.muscles[1].hidden);
  EXPECT_TRUE(state_.view.bones[0].faded);
  isolate(state_.view, part);
  EXPECT_FALSE(state_.view.muscles[1].hidden);
  EXPECT_FALSE(state_.view.bones[0].faded);
}

}  // namespace
}  // namespace myotact::view
