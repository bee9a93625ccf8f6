#include "haptics/proxy/friction.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "support/allocation_guard.h"

namespace myotact::haptics {
namespace {

constexpr double kTick_s = 1e-3;
constexpr double kDepth_m = 1.25e-3;  // 1 N on 800 N/m

Vec3 along(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad), 0.0};
}

/// A tool that drags the sphere over a plane; fibres along x.
struct Drag {
  explicit Drag(const ContactSettings& contact) : settings(contact), friction(contact) {}

  void to(const Vec3& place_m) {
    FrictionTrial trial;
    trial.lag_m = place_m - sphere_m;
    trial.depth_m = kDepth_m;
    trial.fibre = Vec3::UnitX();
    const Vec3 slip_m = friction.slip_m(trial);
    const double speed_m_s = (place_m - tool_m).norm() / kTick_s;
    sphere_m += slip_m;
    tool_m = place_m;
    friction.settle(slip_m.norm(), speed_m_s, kTick_s);
    last_slip_m = slip_m;
  }
  /// On the sphere, over the normal force.
  Vec3 pull() const { return (tool_m - sphere_m) / kDepth_m; }

  ContactSettings settings;
  Friction friction;
  Vec3 sphere_m = Vec3::Zero(), tool_m = Vec3::Zero(), last_slip_m = Vec3::Zero();
};

ContactSettings settings_of(double mu_static, double mu_dynamic, double along_over_across) {
  ContactSettings settings;
  settings.static_friction = mu_static;
  settings.dynamic_friction = mu_dynamic;
  settings.along_over_across = along_over_across;
  return settings;
}

TEST(NearestInEllipse, IsNearerThanEveryOtherPoint) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 2000; ++trial) {
    const Eigen::Vector2d axes(1e-4 + unit(random), 1e-4 + unit(random));
    const Eigen::Vector2d point(4.0 * unit(random) - 2.0, 4.0 * unit(random) - 2.0);
    const Eigen::Vector2d found = nearest_in_ellipse(point, axes);
    const double level = (found.array() / axes.array()).square().sum();
    ASSERT_LE(level, 1.0 + 1e-12);
    if ((point.array() / axes.array()).square().sum() <= 1.0) {
      ASSERT_EQ(found, point);
      continue;
    }
    for (int k = 0; k < 400; ++k) {
      const double angle_rad = 2.0 * std::numbers::pi * k / 400;
      const Eigen::Vector2d rim(axes.x() * std::cos(angle_rad), axes.y() * std::sin(angle_rad));
      ASSERT_GE((point - rim).norm(), (point - found).norm() * (1.0 - 1e-9)) << axes.transpose();
    }
  }
  EXPECT_EQ(nearest_in_ellipse({1.0, 2.0}, {0.0, 0.0}), Eigen::Vector2d(0.0, 0.0));
}

TEST(Friction, BreaksAwayOnTheEllipseInEveryDirection) {
  for (const double ratio : {1.0, 0.5, 2.0}) {
    for (int k = 0; k < 16; ++k) {
      const double angle_rad = 2.0 * std::numbers::pi * k / 16 + 0.1;
      Drag drag(settings_of(0.4, 0.2, ratio));
      double largest = 0.0;
      for (int tick = 0; tick < 2000; ++tick) {
        drag.to(1e-6 * tick * along(angle_rad));
        largest = std::max(largest, drag.pull().norm());
        if (drag.last_slip_m.norm() > 1e-9) break;
      }
      const double expected = 0.4 / std::hypot(std::cos(angle_rad) / ratio, std::sin(angle_rad));
      EXPECT_NEAR(largest, expected, 0.003 * expected) << ratio << " at " << angle_rad;
    }
  }
}

/// Steady sliding along u takes sqrt((mu_along u_x)^2 + (mu_across u_y)^2) a distance and a normal force: the largest
/// power that any force in the ellipse opposes to u.
TEST(Friction, SlidingTakesThePowerOfTheEllipse) {
  for (const double speed_m_s : {0.001, 0.01, 0.05, 0.2}) {
    for (int k = 0; k < 8; ++k) {
      const double angle_rad = 2.0 * std::numbers::pi * k / 8 + 0.2;
      Drag drag(settings_of(0.3, 0.3, 0.6));
      double worst = 0.0;
      const double expected = 0.3 * std::hypot(0.6 * std::cos(angle_rad), std::sin(angle_rad));
      for (int tick = 0; speed_m_s * kTick_s * tick < 5e-3; ++tick) {
        drag.to(speed_m_s * kTick_s * tick * along(angle_rad));
        if (speed_m_s * kTick_s * tick < 4e-3) continue;
        worst = std::max(worst, std::abs(drag.pull().dot(along(angle_rad)) - expected) / expected);
      }
      EXPECT_LT(worst, 0.01) << speed_m_s << " at " << angle_rad;
    }
  }
}

TEST(Friction, FallsWithSpeedAsStribeckSays) {
  ContactSettings settings = settings_of(0.5, 0.2, 1.0);
  settings.stribeck_m_s = 0.01;
  for (const double speed_m_s : {0.002, 0.005, 0.01, 0.02, 0.1}) {
    Drag drag(settings);
    for (int tick = 0; tick < 1500; ++tick) drag.to(speed_m_s * kTick_s * tick * Vec3::UnitX());
    const double expected = 0.2 + 0.3 * std::exp(-std::pow(speed_m_s / 0.01, 2));
    EXPECT_NEAR(drag.pull().norm(), expected, 1e-3 * expected) << speed_m_s;
    drag.to(drag.tool_m + speed_m_s * kTick_s * Vec3::UnitX());
    EXPECT_NEAR(drag.last_slip_m.norm(), speed_m_s * kTick_s, 1e-3 * speed_m_s * kTick_s) << "no stick-slip";
  }
}

TEST(Friction, ViscosityAddsItsForceTimesSpeed) {
  ContactSettings settings = settings_of(0.2, 0.2, 1.0);
  settings.viscous_Ns_m = 2.0;
  for (const double speed_m_s : {0.01, 0.1}) {
    Drag drag(settings);
    for (int tick = 0; tick < 1000; ++tick) drag.to(speed_m_s * kTick_s * tick * Vec3::UnitX());
    const double normal_N = settings.stiffness_N_m * kDepth_m;
    EXPECT_NEAR(drag.pull().norm() * normal_N, 0.2 * normal_N + 2.0 * speed_m_s, 1e-3 * normal_N);
  }
}

TEST(Friction, SticksAgainAfterThreeSlowTicks) {
  Drag drag(settings_of(0.5, 0.1, 1.0));
  int tick = 0;
  for (; tick < 100; ++tick) drag.to(1e-4 * tick * Vec3::UnitX());
  ASSERT_TRUE(drag.friction.sliding());
  const Vec3 stop_m = drag.tool_m;
  for (int still = 0; still < 3; ++still) {
    EXPECT_TRUE(drag.friction.sliding());
    drag.to(stop_m);
  }
  EXPECT_FALSE(drag.friction.sliding());
  EXPECT_EQ(drag.friction.coefficient(), 0.5);
}

TEST(Friction, NeverCreepsInsideTheCone) {
  ContactSettings settings = settings_of(0.3, 0.2, 0.5);
  settings.viscous_Ns_m = 1.0;
  Drag drag(settings);
  for (int tick = 0; tick < 60'000; ++tick) {  // 60 s of tremor just inside
    drag.to(0.14 * kDepth_m * std::sin(0.0565 * tick) * Vec3::UnitX() +
            0.05 * kDepth_m * std::cos(0.041 * tick) * Vec3::UnitY());
  }
  EXPECT_EQ(drag.sphere_m, Vec3::Zero());
}

TEST(Friction, NeverGivesEnergy) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0.0, 1.0);
  ContactSettings settings = settings_of(0.4, 0.2, 0.7);
  settings.viscous_Ns_m = 0.5;
  Drag drag(settings);
  Vec3 velocity_m_s = Vec3::Zero();
  for (int tick = 0; tick < 20'000; ++tick) {
    velocity_m_s = 0.99 * velocity_m_s + 0.01 * Vec3(normal(random), normal(random), 0.0);
    drag.to(drag.tool_m + kTick_s * velocity_m_s);
    ASSERT_GE(drag.pull().dot(drag.last_slip_m), 0.0) << tick;
  }
}

TEST(Friction, AllocatesNothing) {
  Drag drag(settings_of(0.4, 0.2, 0.7));
  const support::AllocationGuard guard;
  for (int tick = 0; tick < 1000; ++tick) drag.to(1e-5 * tick * along(0.3));
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace
}  // namespace myotact::haptics
