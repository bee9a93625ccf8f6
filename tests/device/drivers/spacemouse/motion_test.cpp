#include "device/drivers/spacemouse/motion.h"

#include <gtest/gtest.h>

namespace myotact::device::spacemouse {
namespace {

constexpr double kTick_s = 1e-3;

Cap pushed(int x, int y, int z) {
  Cap cap;
  cap.push = {x, y, z};
  return cap;
}

void run(Motion& motion, const Cap& cap, int ticks) {
  for (int i = 0; i < ticks; ++i) motion.advance(cap, kTick_s);
}

TEST(SpaceMouseMotion, RawAxesBecomeRightUpAndTowardsThePerson) {
  const MotionSettings settings;
  EXPECT_EQ(shaped_push(pushed(350, 0, 0), settings), Vec3(1, 0, 0));
  EXPECT_EQ(shaped_push(pushed(0, 350, 0), settings), Vec3(0, 0, 1));
  EXPECT_EQ(shaped_push(pushed(0, 0, 350), settings), Vec3(0, -1, 0));
  MotionSettings turned;
  turned.axis_signs = Vec3(1, -1, -1);
  EXPECT_EQ(shaped_push(pushed(350, 350, 350), turned), Vec3(1, 1, -1));
}

TEST(SpaceMouseMotion, ADeadZoneThenTheCurveUpToOne) {
  MotionSettings settings;
  settings.dead_zone = 0.1;
  EXPECT_EQ(shaped_push(pushed(35, -35, 20), settings), Vec3(0, 0, 0));
  // 0.55 of full deflection is in the middle between the dead zone and one; the curve squares it.
  EXPECT_NEAR(shaped_push(pushed(-192, 0, 0), settings).x(), -0.25, 2e-3);
  settings.curve_exponent = 1.0;
  EXPECT_NEAR(shaped_push(pushed(-192, 0, 0), settings).x(), -0.5, 2e-3);
  for (int raw = -400; raw < 400; ++raw) {
    EXPECT_LE(shaped_push(pushed(raw, 0, 0), settings).x(), shaped_push(pushed(raw + 1, 0, 0), settings).x());
  }
}

TEST(SpaceMouseMotion, RateModeMovesWhilePushedAndStaysWhereItIsAfterwards) {
  MotionSettings settings;
  Motion motion(settings);
  run(motion, pushed(350, 0, 0), 500);
  EXPECT_NEAR(motion.velocity_m_s().x(), settings.full_speed_m_s, 1e-6);
  // Half a second at full speed, less what the lag of 20 ms costs at the start.
  EXPECT_NEAR(motion.position_m().x(), settings.full_speed_m_s * (0.5 - 0.02), 1e-3);
  run(motion, Cap(), 500);
  const Vec3 rest_m = motion.position_m();
  EXPECT_NEAR(motion.velocity_m_s().norm(), 0.0, 1e-9);
  run(motion, Cap(), 500);
  EXPECT_LT((motion.position_m() - rest_m).norm(), 1e-9);
  EXPECT_GT(rest_m.x(), 0.05);
}

TEST(SpaceMouseMotion, RateModeEndsAtTheEdgeOfTheWorkspaceAndComesBackAtOnce) {
  MotionSettings settings;
  Motion motion(settings);
  run(motion, pushed(0, 0, -350), 3000);
  EXPECT_EQ(motion.position_m(), Vec3(0, settings.half_workspace_m, 0));
  EXPECT_EQ(motion.velocity_m_s(), Vec3(0, 0, 0));
  run(motion, pushed(0, 0, 350), 2);
  EXPECT_LT(motion.position_m().y(), settings.half_workspace_m);
}

TEST(SpaceMouseMotion, PositionModeFollowsTheCapAndComesBackWithIt) {
  MotionSettings settings;
  settings.mode = MotionMode::Position;
  Motion motion(settings);
  run(motion, pushed(0, -350, 0), 300);
  EXPECT_NEAR(motion.position_m().z(), -settings.full_offset_m, 1e-6);
  run(motion, Cap(), 300);
  EXPECT_NEAR(motion.position_m().norm(), 0.0, 1e-6);
}

TEST(SpaceMouseMotion, TheVelocityIsTheSlopeOfThePosition) {
  for (const MotionMode mode : {MotionMode::Rate, MotionMode::Position}) {
    MotionSettings settings;
    settings.mode = mode;
    Motion motion(settings);
    for (int i = 0; i < 100; ++i) {
      const Vec3 before_m = motion.position_m();
      const Vec3 early_m_s = motion.velocity_m_s();
      motion.advance(pushed(200, 100, -300), kTick_s);
      const Vec3 slope_m_s = (motion.position_m() - before_m) / kTick_s;
      const Vec3 late_m_s = motion.velocity_m_s();
      if (i == 0) continue;  // the cap jumps
      // Between the velocities at both ends of the tick, which the lag keeps within 5 %.
      EXPECT_LT((slope_m_s - 0.5 * (early_m_s + late_m_s)).norm(), 0.06 * early_m_s.norm() + 4e-3);
    }
  }
}

TEST(SpaceMouseMotion, AStoppedProcessMovesNoFarther) {
  const MotionSettings settings;
  Motion motion(settings);
  run(motion, pushed(350, 0, 0), 200);
  const double before_m = motion.position_m().x();
  motion.advance(pushed(350, 0, 0), 60.0);
  EXPECT_LT(motion.position_m().x() - before_m, 0.021 * settings.full_speed_m_s);
  motion.advance(pushed(350, 0, 0), -1.0);
  EXPECT_LT(motion.position_m().x() - before_m, 0.021 * settings.full_speed_m_s);
}

TEST(SpaceMouseMotion, HaltStopsAtOnce) {
  Motion motion{MotionSettings()};
  run(motion, pushed(350, 0, 0), 200);
  motion.halt();
  EXPECT_EQ(motion.velocity_m_s(), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace myotact::device::spacemouse
