#include "haptics/effects/bone_drag.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace myotact::haptics {
namespace {

constexpr double kDt_s = 1e-3;
constexpr double kPeak_N = 100.0;

/// A point at the origin that stands still; `mobility_1_kg` in z.
messages::LocalModel still_point(double mobility_1_kg = 0.0) {
  messages::LocalModel model;
  model.dt_ns = 10'000'000;
  model.grip.body = 2;
  model.grip.point_rest_m = {0.1, 0.2, 0.3};
  model.grip.mobility_1_kg[8] = mobility_1_kg;
  return model;
}

/// A hand, a clock and the newest model.
struct Hand {
  BoneDrag drag{BoneDragSettings{}};
  messages::LocalModel model;
  std::uint64_t sequence = 0;

  Vec3 tick(const Vec3& hand_m, bool holds, bool is_new = false) {
    return drag.tick(&model, is_new, {hand_m, Vec3::Zero(), holds, kPeak_N, ++sequence}, kDt_s);
  }
  Vec3 hold(const Vec3& hand_m, int ticks) {
    Vec3 force_N = Vec3::Zero();
    for (int i = 0; i < ticks; ++i) force_N = tick(hand_m, true);
    return force_N;
  }
};

const Vec3 kTaken_m(0.0, 0.01, 0.02);  // where the hand closes

TEST(BoneDrag, IsSlackWhereTheHandClosedAndASpringBesideIt) {
  Hand hand{.model = still_point()};
  EXPECT_EQ(hand.hold(kTaken_m, 200).norm(), 0.0);
  EXPECT_EQ(hand.drag.body(), 2);
  EXPECT_EQ(hand.drag.point_rest_m(), hand.model.grip.point_rest_m);
  const Vec3 way_m(2e-3, -1e-3, 3e-3);
  const double k = BoneDragSettings{}.stiffness_N_m;
  EXPECT_LT((hand.hold(kTaken_m + way_m, 1) + k * way_m).norm(), 1e-9);
  // The simulation's spring, from the point, gives the bone the opposite.
  EXPECT_EQ(hand.drag.stiffness_N_m(), k);
  EXPECT_LT((hand.drag.target_m() - way_m).norm(), 1e-12);
}

TEST(BoneDrag, RisesAndDiesOverAHundredMilliseconds) {
  Hand hand{.model = still_point()};
  hand.hold(kTaken_m, 1);
  const Vec3 pulled_m = kTaken_m + Vec3(0.0, 0.0, 5e-3);
  const double full_N = BoneDragSettings{}.stiffness_N_m * 5e-3;
  for (int tick = 2; tick <= 100; ++tick) EXPECT_NEAR(hand.tick(pulled_m, true).norm(), full_N * 0.01 * tick, 1e-9);
  EXPECT_NEAR(hand.hold(pulled_m, 50).norm(), full_N, 1e-9);
  for (int tick = 1; tick < 100; ++tick) {
    EXPECT_NEAR(hand.tick(pulled_m, false).norm(), full_N * (1.0 - 0.01 * tick), 1e-9);
    EXPECT_NEAR(hand.drag.stiffness_N_m() * 5e-3, full_N * (1.0 - 0.01 * tick), 1e-9);  // in the simulation too
  }
  hand.tick(pulled_m, false);
  hand.tick(pulled_m, false);
  EXPECT_EQ(hand.drag.body(), -1);
  EXPECT_EQ(hand.drag.stiffness_N_m(), 0.0);
}

TEST(BoneDrag, NothingNearIsNothingInHandUntilTheButtonGoesDownAgain) {
  Hand hand;
  hand.hold(kTaken_m, 10);
  hand.model = still_point();
  EXPECT_EQ(hand.hold(kTaken_m, 200).norm(), 0.0);
  EXPECT_EQ(hand.drag.body(), -1);
  hand.tick(kTaken_m, false);
  hand.tick(kTaken_m, true);
  EXPECT_EQ(hand.drag.body(), 2);
}

TEST(BoneDrag, NoModelIsNothingInHand) {
  BoneDrag drag{BoneDragSettings{}};
  EXPECT_EQ(drag.tick(nullptr, false, {kTaken_m, Vec3::Zero(), true, kPeak_N, 1}, kDt_s).norm(), 0.0);
  EXPECT_EQ(drag.body(), -1);
}

// A mass on the grip's spring swings with the period 2 pi sqrt(m / k) while no model comes.
TEST(BoneDrag, BetweenModelsThePointMovesByItsMass) {
  const double mass_kg = 2.0;
  Hand hand{.drag = BoneDrag{{800.0, 0.0, 1.0}}, .model = still_point(1.0 / mass_kg)};
  hand.hold(kTaken_m, 200);
  const Vec3 pulled_m = kTaken_m + Vec3(0.0, 0.0, 1e-3);
  int first = 0, third = 0;  // ticks at which the force changes its sign
  double last_N = 0.0;
  for (int i = 0, changes = 0; i < 1000 && third == 0; ++i) {
    const double force_N = hand.tick(pulled_m, true).z();
    if (force_N * last_N < 0.0) {
      ++changes;
      if (changes == 1) first = i;
      if (changes == 3) third = i;
    }
    last_N = force_N;
  }
  const double period_s = 2.0 * std::numbers::pi * std::sqrt(mass_kg / 800.0);
  EXPECT_NEAR((third - first) * kDt_s, period_s, 0.01 * period_s);
}

// Across its direction of travel the point stands like a wall.
TEST(BoneDrag, APointMovesOnlyWhereTheJointsLetIt) {
  Hand hand{.model = still_point(10.0)};
  hand.hold(kTaken_m, 200);
  const Vec3 force_N = hand.hold(kTaken_m + Vec3(1e-3, 0.0, 1e-3), 1500);
  EXPECT_NEAR(force_N.x(), -BoneDragSettings{}.stiffness_N_m * 1e-3, 1e-9);
  EXPECT_LT(std::abs(force_N.z()), 1e-3);  // it came along
}

TEST(BoneDrag, ForcesStayBelowThePeakOnBothSides) {
  Hand hand{.model = still_point(10.0)};
  hand.hold(kTaken_m, 200);
  const Vec3 far_m = kTaken_m + Vec3(10.0, 0.0, 0.0);
  const Vec3 force_N = hand.hold(far_m, 1);
  EXPECT_NEAR(force_N.norm(), kPeak_N, 1e-9);
  EXPECT_LT((hand.drag.stiffness_N_m() * hand.drag.target_m() + force_N).norm(), 1e-6);  // the point is at the origin
}

TEST(BoneDrag, AForceScaleScalesWhatIsFeltAndStiffensTheGripInTheSimulation) {
  Hand hand{.drag = BoneDrag{{800.0, 1.0, 0.1}}, .model = still_point()};
  hand.hold(kTaken_m, 200);
  const Vec3 force_N = hand.hold(kTaken_m + Vec3(0.0, 0.0, 1e-3), 50);
  EXPECT_NEAR(force_N.z(), -0.8, 1e-9);
  EXPECT_NEAR(hand.drag.stiffness_N_m(), 8000.0, 1e-6);
  EXPECT_NEAR(hand.drag.stiffness_N_m() * hand.drag.target_m().z(), 8.0, 1e-9);
}

/// The point is 1 mm higher in the simulation than here. Each model takes away half of what is left, whatever its age.
TEST(BoneDrag, ModelsCorrectThePointByHalfOfTheError) {
  for (const std::uint64_t age : {1u, 11u}) {
    Hand hand{.model = still_point()};
    hand.hold(kTaken_m, 200);
    hand.model.grip.position_world_m = {0.0, 0.0, 1e-3};
    double left_m = 1e-3;
    for (int model = 0; model < 4; ++model) {
      hand.model.tool_sequence = hand.sequence + 1 - age;
      double last_N = hand.tick(kTaken_m, true, true).z();
      for (int tick = 1; tick < 10; ++tick) {
        const double force_N = hand.tick(kTaken_m, true).z();
        EXPECT_LT(std::abs(force_N - last_N), 0.8 * 0.11);  // spread over the step, never at once
        last_N = force_N;
      }
      left_m *= 0.5;
      EXPECT_NEAR(last_N, 800.0 * (1e-3 - left_m), 1e-9);
    }
  }
}

TEST(BoneDrag, AModelOfAnotherPointCorrectsNothing) {
  Hand hand{.model = still_point()};
  hand.hold(kTaken_m, 200);
  hand.model.grip.point_rest_m[0] += 1e-3;
  hand.model.grip.position_world_m = {0.0, 0.0, 0.5};
  hand.model.tool_sequence = hand.sequence;
  hand.tick(kTaken_m, true, true);
  EXPECT_EQ(hand.hold(kTaken_m, 20).norm(), 0.0);
}

}  // namespace
}  // namespace myotact::haptics
