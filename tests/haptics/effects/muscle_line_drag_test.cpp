#include "haptics/effects/muscle_line_drag.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myotact::haptics {
namespace {

constexpr double kDt_s = 1e-3;

/// A straight line of 0.2 m under 10 N along x.
messages::LocalLine straight_line() {
  messages::LocalLine line;
  line.muscle = 3;
  line.fraction = 0.5;
  line.proximal_point_world_m = {-0.1, 0, 0};
  line.distal_point_world_m = {0.1, 0, 0};
  line.tension_N = 10.0;
  line.length_m = 0.2;
  return line;
}

Vec3 hold(MuscleLineDrag& drag, const messages::LocalLine& line, const Vec3& tool_m, int ticks) {
  Vec3 force_N = Vec3::Zero();
  for (int tick = 0; tick < ticks; ++tick) force_N = drag.tick(line, {tool_m, Vec3::Zero(), true}, kDt_s);
  return force_N;
}

//   o---------- L ----------o
//         \  d  /               F = 2 T d / sqrt((L/2)^2 + d^2), back towards the line
//           tool
TEST(MuscleLineDrag, SidewaysForceIsThatOfAString) {
  for (const double d_m : {0.002, 0.01, 0.04}) {
    MuscleLineDrag drag{LineDragSettings{}};
    messages::LocalLine line = straight_line();
    line.length_m = 2.0 * std::hypot(0.1, d_m);  // the tension is that of the drawn line
    const Vec3 force_N = hold(drag, line, Vec3(0, 0, d_m), 150);
    EXPECT_NEAR(force_N.z(), -2.0 * 10.0 * d_m / std::hypot(0.1, d_m), 1e-9);
    EXPECT_NEAR(force_N.x(), 0.0, 1e-9);
    EXPECT_EQ(drag.muscle(), 3);
    EXPECT_EQ(drag.fraction(), 0.5);
  }
}

TEST(MuscleLineDrag, TensionFollowsLengthBetweenModels) {
  MuscleLineDrag drag{LineDragSettings{}};
  messages::LocalLine line = straight_line();
  line.stiffness_N_m = 500.0;
  line.damping_Ns_m = 4.0;
  const double d_m = 0.02;
  hold(drag, line, Vec3(0, 0, d_m), 150);
  drag.tick(line, {Vec3(0, 0, d_m), Vec3(0, 0, 0.1), true}, kDt_s);
  const double length_m = 2.0 * std::hypot(0.1, d_m);
  const double lengthening_m_s = 2.0 * d_m / std::hypot(0.1, d_m) * 0.1;
  EXPECT_NEAR(drag.tension_N(), 10.0 + 500.0 * (length_m - 0.2) + 4.0 * lengthening_m_s, 1e-9);
}

TEST(MuscleLineDrag, ASlackLineDoesNotPush) {
  MuscleLineDrag drag{LineDragSettings{}};
  messages::LocalLine line = straight_line();
  line.tension_N = 0.0;
  line.stiffness_N_m = 1000.0;
  line.length_m = 0.3;
  EXPECT_EQ(hold(drag, line, Vec3(0, 0, 0.01), 150).norm(), 0.0);
}

TEST(MuscleLineDrag, ReleaseDiesOutOverAHundredMilliseconds) {
  MuscleLineDrag drag{LineDragSettings{}};
  const Vec3 tool_m(0, 0, 0.02);
  const double held_N = hold(drag, straight_line(), tool_m, 200).norm();
  for (int tick = 1; tick <= 100; ++tick) {
    const double force_N = drag.tick(messages::LocalLine{}, {tool_m, Vec3::Zero(), false}, kDt_s).norm();
    EXPECT_NEAR(force_N, held_N * (1.0 - 0.01 * tick), 1e-9);
    EXPECT_EQ(drag.muscle(), -1);
  }
}

TEST(MuscleLineDrag, NothingNearIsNothingInHandUntilTheButtonGoesDownAgain) {
  MuscleLineDrag drag{LineDragSettings{}};
  hold(drag, messages::LocalLine{}, Vec3::Zero(), 10);
  EXPECT_EQ(hold(drag, straight_line(), Vec3(0, 0, 0.01), 200).norm(), 0.0);
  drag.tick(straight_line(), {Vec3::Zero(), Vec3::Zero(), false}, kDt_s);
  EXPECT_GT(hold(drag, straight_line(), Vec3(0, 0, 0.01), 200).norm(), 0.5);
}

TEST(MuscleLineDrag, KeepsItsMuscleWhenAnotherComesNearer) {
  MuscleLineDrag drag{LineDragSettings{}};
  const double before_N = hold(drag, straight_line(), Vec3(0, 0, 0.01), 200).norm();
  messages::LocalLine other = straight_line();
  other.muscle = 5;
  other.tension_N = 19.0;
  EXPECT_NEAR(hold(drag, other, Vec3(0, 0, 0.01), 5).norm(), before_N, 1e-12);
  EXPECT_EQ(drag.muscle(), 3);
}

TEST(MuscleLineDrag, AToolOnAnEndOfTheLineGetsAFiniteForce) {
  MuscleLineDrag drag{LineDragSettings{}};
  EXPECT_TRUE(hold(drag, straight_line(), Vec3(0.1, 0, 0), 200).allFinite());
}

}  // namespace
}  // namespace myotact::haptics
