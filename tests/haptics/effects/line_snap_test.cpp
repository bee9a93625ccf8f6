#include "haptics/effects/line_snap.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myotact::haptics {
namespace {

constexpr double kDt_s = 1e-3;
constexpr LineSnapSettings kSettings{0.3, 8e-3};

/// Along x through the origin.
messages::LocalLine line_along_x(int muscle = 2) {
  messages::LocalLine line;
  line.muscle = muscle;
  line.proximal_point_world_m = {-0.05, 0.0, 0.0};
  line.distal_point_world_m = {0.05, 0.0, 0.0};
  return line;
}

LineSnap taken_up(const messages::LocalLine& line) {
  LineSnap snap(kSettings);
  for (int tick = 0; tick < 50; ++tick) snap.tick(line, Vec3(0.0, 1.0, 0.0), true, kDt_s);
  return snap;
}

TEST(LineSnap, DrawsInAndHoldsBackAndNeverPullsHarderThanAsked) {
  LineSnap snap = taken_up(line_along_x());
  double largest_N = 0.0;
  for (int um = -10'000; um <= 10'000; um += 10) {
    const Vec3 force_N = snap.tick(line_along_x(), Vec3(0.01, 1e-6 * um, 0.0), true, kDt_s);
    EXPECT_LE(force_N.y() * um, 0.0);
    EXPECT_NEAR(force_N.x(), 0.0, 1e-12);
    EXPECT_TRUE(std::abs(um) < 8000 || force_N.norm() < 1e-12);
    largest_N = std::max(largest_N, force_N.norm());
  }
  EXPECT_NEAR(largest_N, kSettings.force_N, 1e-5);
}

// Whatever closed way the tool takes over the line, it gets nothing.
TEST(LineSnap, AClosedWayGivesNothing) {
  LineSnap snap = taken_up(line_along_x());
  double work_J = 0.0, spent_J = 0.0;
  const auto place_m = [](int i) {
    const double turn = 2.0 * 3.14159265358979 * i / 100'000.0;
    return Vec3(2e-3 * std::sin(2.0 * turn), 3e-3 + 6e-3 * std::cos(turn), 2e-3 + 1e-3 * std::sin(turn));
  };
  for (int i = 0; i < 100'000; ++i) {
    const Vec3 step_m = place_m(i + 1) - place_m(i);
    const double part_J = snap.tick(line_along_x(), 0.5 * (place_m(i) + place_m(i + 1)), true, kDt_s).dot(step_m);
    work_J += part_J;
    spent_J += std::abs(part_J);
  }
  EXPECT_GT(spent_J, 1e-3);
  EXPECT_LT(std::abs(work_J), 1e-9);
}

TEST(LineSnap, AClosedHandAndAnotherLineFadeOutWithoutAKnock) {
  const Vec3 tool_m(0.0, 4e-3, 0.0);
  LineSnap snap = taken_up(line_along_x());
  double last_N = snap.tick(line_along_x(), tool_m, true, kDt_s).norm();
  EXPECT_GT(last_N, 0.2);
  for (int tick = 0; tick < 100; ++tick) {
    const double force_N = snap.tick(line_along_x(7), tool_m, true, kDt_s).norm();
    EXPECT_LT(std::abs(force_N - last_N), 0.3 / 25.0);
    last_N = force_N;
  }
  EXPECT_GT(last_N, 0.2);
  for (int tick = 0; tick < 31; ++tick) last_N = snap.tick(line_along_x(7), tool_m, false, kDt_s).norm();
  EXPECT_EQ(last_N, 0.0);
  EXPECT_EQ(snap.held_J(), 0.0);
}

TEST(LineSnap, NoLineAndNoSettingAreNothing) {
  LineSnap off{LineSnapSettings{}};
  for (int tick = 0; tick < 50; ++tick)
    EXPECT_EQ(off.tick(line_along_x(), Vec3(0.0, 1e-3, 0.0), true, kDt_s).norm(), 0.0);
  LineSnap snap(kSettings);
  for (int tick = 0; tick < 50; ++tick)
    EXPECT_EQ(snap.tick(messages::LocalLine{}, Vec3(0.0, 1e-3, 0.0), true, kDt_s).norm(), 0.0);
}

}  // namespace
}  // namespace myotact::haptics
