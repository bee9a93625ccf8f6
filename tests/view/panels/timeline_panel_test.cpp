#include "view/panels/timeline_panel.h"

#include <gtest/gtest.h>

namespace myotact::view {
namespace {

/// A simulation that goes on, a frame each fiftieth of a second, and a person who looks back at it.
class LookingBack : public ::testing::Test {
 protected:
  static messages::SceneFrame moment(int number) {
    messages::SceneFrame frame;
    frame.sequence = static_cast<std::uint64_t>(number) + 1;
    frame.time_s = 0.02 * number;
    frame.body_poses.assign(1, {1, 0, 0, static_cast<double>(number), 0, 1, 0, 0, 0, 0, 1, 0});
    return frame;
  }
  /// The number of the moment that is drawn.
  int drawn_at(int now) {
    const messages::SceneFrame present = moment(now);
    return static_cast<int>(timeline_.choose(present).body_poses[0][3]);
  }
  void simulate_to(int last) {
    for (int i = 0; i <= last; ++i) ASSERT_EQ(drawn_at(i), i);
  }

  TimelinePanel timeline_;
};

TEST_F(LookingBack, BeforeAnythingWasSimulatedThereIsOnlyThePresent) {
  timeline_.step(-1);
  timeline_.step(1);
  EXPECT_FALSE(timeline_.looks_back());
  const messages::SceneFrame nothing;
  EXPECT_EQ(&timeline_.choose(nothing), &nothing);
}

TEST_F(LookingBack, AMomentStaysWhileTheSimulationGoesOn) {
  simulate_to(100);
  timeline_.step(-1);
  EXPECT_TRUE(timeline_.looks_back());
  for (int now = 101; now < 200; ++now) ASSERT_EQ(drawn_at(now), 99) << now;
  timeline_.step(-1);
  EXPECT_EQ(drawn_at(200), 98);
  timeline_.step(1);
  timeline_.step(1);
  EXPECT_EQ(drawn_at(201), 100);
  timeline_.back_to_now();
  EXPECT_EQ(drawn_at(202), 202);
}

TEST_F(LookingBack, EndsAtTheFirstMomentAndAtThePresent) {
  simulate_to(5);
  timeline_.step(-100);
  EXPECT_EQ(drawn_at(6), 0);
  timeline_.step(-1);
  EXPECT_EQ(drawn_at(6), 0);
  for (int i = 1; i < 6; ++i) {
    timeline_.step(1);
    EXPECT_EQ(drawn_at(6), i);
    EXPECT_TRUE(timeline_.looks_back());
  }
  timeline_.step(1);
  EXPECT_FALSE(timeline_.looks_back()) << "past the newest: the present";
  EXPECT_EQ(drawn_at(7), 7);
}

TEST_F(LookingBack, ASceneThatIsBegunAnewIsSeenFromItsBeginning) {
  simulate_to(50);
  timeline_.step(-10);
  EXPECT_EQ(drawn_at(51), 40);
  EXPECT_EQ(drawn_at(0), 0) << "the moment that was looked at is no more";
  EXPECT_FALSE(timeline_.looks_back());
  EXPECT_EQ(drawn_at(1), 1);
}

TEST_F(LookingBack, ASceneThatIsBegunAnewIsSeenByWhoLookedAtItsFirstMomentToo) {
  simulate_to(50);
  timeline_.step(-100);
  EXPECT_EQ(drawn_at(51), 0);
  EXPECT_EQ(drawn_at(0), 0);
  EXPECT_EQ(drawn_at(1), 1) << "what is looked at was of the time before";
}

}  // namespace
}  // namespace myotact::view
