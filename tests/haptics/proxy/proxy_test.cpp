#include "haptics/proxy/proxy.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "haptics/effort.h"
#include "haptics/haptic_loop.h"
#include "haptics/surface_player.h"

namespace myotact::haptics {
namespace {

ContactSettings settings_with(double friction) {
  ContactSettings settings;
  settings.static_friction = settings.dynamic_friction = friction;
  return settings;
}

/// A plane that moves as a whole by `offset(t)`.
SurfacePlayer plane_player(const ContactSettings& settings, std::function<Vec3(double)> offset) {
  const geometry::TriangleMesh plane = geometry::make_plane(0.06, 12);
  return SurfacePlayer(
      plane,
      [plane, offset](double t) {
        std::vector<Vec3> vertices_m = plane.positions_m;
        for (Vec3& v : vertices_m) v += offset(t);
        return vertices_m;
      },
      settings);
}

Vec3 at_rest(double) {
  return Vec3::Zero();
}

TEST(Proxy, FollowsTheDeviceThroughFreeSpace) {
  SurfacePlayer player = plane_player(settings_with(0.3), at_rest);
  for (int tick = 0; tick < 50; ++tick) player.tick({Vec3(1e-4 * tick, 0, 0.02), Vec3(0.1, 0, 0)});
  EXPECT_NEAR((player.proxy.position_m() - Vec3(0.0049, 0, 0.02)).norm(), 0.0, 1e-9);
  EXPECT_FALSE(player.proxy.contact().active);
}

TEST(Proxy, PressingGivesStiffnessTimesDepth) {
  const ContactSettings settings = settings_with(0.3);
  for (const double depth_m : {0.5e-3, 2e-3, 5e-3}) {
    SurfacePlayer player = plane_player(settings, at_rest);
    player.tick({Vec3(1e-3, 2e-3, 0.02), Vec3::Zero()});
    const ProxyGoal pressed{Vec3(1e-3, 2e-3, settings.radius_m - depth_m), Vec3::Zero()};
    for (int tick = 0; tick < 20; ++tick) player.tick(pressed);
    const Vec3 force_N = coupling_force_N(player.proxy, pressed, settings);
    EXPECT_NEAR(force_N.z(), settings.stiffness_N_m * depth_m, 1e-3 * settings.stiffness_N_m * depth_m);
    EXPECT_NEAR(force_N.head<2>().norm(), 0.0, 1e-6);
  }
}

TEST(Proxy, PressingARisingOrFallingPlaneKeepsTheForceOfItsDepth) {
  const ContactSettings settings = settings_with(0.3);
  for (const double speed_m_s : {-0.05, 0.05}) {
    SurfacePlayer player = plane_player(settings, [=](double t) { return Vec3(0, 0, speed_m_s * t); });
    const double depth_m = 2e-3;
    for (int tick = 1; tick <= 200; ++tick) {
      const double plane_m = speed_m_s * 1e-3 * tick;
      const double height_m = plane_m + settings.radius_m - (tick < 20 ? -1e-3 : depth_m);
      const ProxyGoal goal{Vec3(0, 0, height_m), Vec3(0, 0, speed_m_s)};
      player.tick(goal);
      if (tick < 40) continue;
      EXPECT_NEAR(coupling_force_N(player.proxy, goal, settings).z(), settings.stiffness_N_m * depth_m,
                  0.01 * settings.stiffness_N_m * depth_m);
    }
  }
}

TEST(Proxy, SlidingRecoversTheFrictionCoefficient) {
  for (const double mu : {0.1, 0.3, 0.6}) {
    for (const double speed_m_s : {0.001, 0.02, 0.2}) {
      const ContactSettings settings = settings_with(mu);
      SurfacePlayer player = plane_player(settings, at_rest);
      const double depth_m = 1.5e-3;
      const double start_m = -0.5 * std::min(0.04, speed_m_s * 2.0);
      player.tick({Vec3(start_m, 1.3e-3, 0.01), Vec3::Zero()});
      double worst = 0.0;
      const int ticks = static_cast<int>(std::min(120.0 * kEffort, 0.04 / speed_m_s * 1e3));
      for (int tick = 0; tick < ticks; ++tick) {
        const ProxyGoal goal{Vec3(start_m + speed_m_s * 1e-3 * tick, 1.3e-3, settings.radius_m - depth_m),
                             Vec3(speed_m_s, 0, 0)};
        player.tick(goal);
        if (speed_m_s * 1e-3 * tick < 1.2 * mu * depth_m) continue;  // the string of the coupling is still being drawn
        const Vec3 force_N = coupling_force_N(player.proxy, goal, settings);
        worst = std::max(worst, std::abs(-force_N.x() / force_N.z() - mu));
      }
      EXPECT_LT(worst, 0.01 * mu) << "mu " << mu << " at " << speed_m_s << " m/s";
    }
  }
}

TEST(Proxy, SticksUntilTheForceLeavesTheCone) {
  const ContactSettings settings = settings_with(0.5);
  SurfacePlayer player = plane_player(settings, at_rest);
  player.tick({Vec3(0, 0, 0.01), Vec3::Zero()});
  const double depth_m = 2e-3;
  player.tick({Vec3(0, 0, settings.radius_m - depth_m), Vec3::Zero()});
  const Vec3 stuck_m = player.proxy.position_m();
  for (int tick = 0; tick <= 99; ++tick) player.tick({Vec3(1e-5 * tick, 0, settings.radius_m - depth_m), Vec3::Zero()});
  EXPECT_LT((player.proxy.position_m() - stuck_m).norm(), 1e-6);  // 0.99 mm of the 1 mm at which it slips
  player.tick({Vec3(1.2e-3, 0, settings.radius_m - depth_m), Vec3::Zero()});
  EXPECT_NEAR(player.proxy.position_m().x() - stuck_m.x(), 0.2e-3, 1e-6);
  EXPECT_TRUE(player.proxy.contact().sliding);
}

TEST(Proxy, SticksToMovingTissueWithoutDrift) {
  const ContactSettings settings = settings_with(0.6);
  const auto swing = [](double t) {
    return Vec3(4e-3 * std::sin(2 * std::numbers::pi * 2.0 * t), 0, 1e-3 * std::sin(9.0 * t));
  };
  SurfacePlayer player = plane_player(settings, swing);
  player.tick({Vec3(0, 0, 0.01), Vec3::Zero()});
  Vec3 first_m = Vec3::Zero();
  for (int tick = 2; tick <= 150 * kEffort; ++tick) {
    // The hand rides on the tissue, 3 mm deep, and trembles by 0.2 mm at 9 Hz.
    const Vec3 tremor_m(0.2e-3 * std::sin(2 * std::numbers::pi * 9.0 * player.time_s()), 0, 0);
    player.tick({swing(player.time_s() + 1e-3) + tremor_m, Vec3::Zero()});
    const Vec3 relative_m =
        player.proxy.position_m() - (player.surface_now_m()[84] - geometry::make_plane(0.06, 12).positions_m[84]);
    if (tick == 30) first_m = relative_m;
    if (tick < 30) continue;
    ASSERT_LT((relative_m - first_m).norm(), 20e-6) << "tick " << tick;
  }
}

TEST(Proxy, ARisingSurfaceHitsAProxyThatRestsOnItsGoal) {
  for (const double speed_m_s : {0.02, 0.1, 0.5}) {
    const ContactSettings settings = settings_with(0.3);
    SurfacePlayer player = plane_player(settings, [=](double t) { return Vec3(0, 0, speed_m_s * t - 5e-3); });
    const int ticks = static_cast<int>(13e-3 / speed_m_s * 1e3);  // until the surface is 8 mm above the device
    for (int tick = 0; tick < ticks; ++tick) player.tick({Vec3::Zero(), Vec3::Zero()});
    const double plane_m = player.surface_now_m()[0].z();
    EXPECT_NEAR(player.proxy.position_m().z(), plane_m + settings.radius_m, 1e-6) << speed_m_s;
    EXPECT_EQ(player.proxy.counters().rescues, 0u);
  }
}

TEST(Proxy, ADeviceThatStartsInsideIsPutOutside) {
  const geometry::TriangleMesh box = geometry::make_box(Vec3(0.04, 0.04, 0.04), 4);
  SurfacePlayer player(box, [&](double) { return box.positions_m; }, {});
  for (int tick = 0; tick < 30; ++tick) player.tick({Vec3(0, 0, 0.015), Vec3::Zero()});
  EXPECT_NEAR(player.proxy.position_m().z(), 0.02 + ContactSettings{}.radius_m, 1e-6);
}

TEST(Proxy, StaysWithinWhatTheModelCovers) {
  SurfacePlayer player = plane_player({}, at_rest);
  player.tick({Vec3(0, 0, 0.01), Vec3::Zero()});
  for (int tick = 0; tick < 8; ++tick) player.tick({Vec3(1.0, 0, 0.01), Vec3::Zero()});
  const Vec3 centre_m = to_vec3(player.model().coverage_centre_world_m);
  EXPECT_LE((player.proxy.position_m() - centre_m).norm(), player.model().coverage_radius_m);
}

TEST(Proxy, AThinSheetStopsAFastPlunge) {
  const double thickness_m = 0.2e-3;
  const geometry::TriangleMesh sheet = geometry::make_box(Vec3(0.04, 0.04, thickness_m), 6);
  for (const double speed_m_s : {0.1, 0.5, 2.0}) {
    ContactSettings settings = settings_with(0.2);
    settings.radius_m = 1e-3;
    SurfacePlayer player(
        sheet, [&](double) { return sheet.positions_m; }, settings);
    for (int tick = 0; tick < 250; ++tick) {
      const double height_m = std::max(0.01 - 1e-3 * speed_m_s * tick, -0.012);
      player.tick({Vec3(1e-3, 1.7e-3, height_m), Vec3(0, 0, -speed_m_s)});
      ASSERT_GE(player.proxy.position_m().z(), std::min(height_m, 0.5 * thickness_m + settings.radius_m) - 1e-6);
      if (height_m < 0.0) {
        ASSERT_GT(player.proxy.position_m().z(), 0.5 * thickness_m + 0.999 * settings.radius_m);
      }
    }
    EXPECT_EQ(player.proxy.counters().rescues, 0u);
  }
}

TEST(Proxy, RestsInAGrooveOnBothSides) {
  const double half_angle_rad = 5.0 * std::numbers::pi / 180.0;
  const geometry::TriangleMesh groove = geometry::make_groove(2.0 * half_angle_rad, 0.08, 16);
  ContactSettings settings = settings_with(0.0);
  settings.radius_m = 1e-3;
  SurfacePlayer player(
      groove, [&](double) { return groove.positions_m; }, settings);
  for (int tick = 0; tick < 200; ++tick) player.tick({Vec3(0, 0, 0.03 - 2e-4 * tick), Vec3::Zero()});
  EXPECT_NEAR(player.proxy.position_m().z(), settings.radius_m / std::sin(half_angle_rad), 2e-5);
  EXPECT_NEAR(player.proxy.position_m().x(), 0.0, 1e-6);
}

// Walls that close under a sphere lift it faster than either of them moves along its normal: the contact's speed is the
// sphere's, not a wall's.
TEST(Proxy, AGrooveThatClosesCarriesTheSphereUp) {
  const double half_angle_rad = 40.0 * std::numbers::pi / 180.0, rate_1_s = 0.5;
  const geometry::TriangleMesh groove = geometry::make_groove(2.0 * half_angle_rad, 0.08, 16);
  const auto closing = [&](double time_s) {
    std::vector<Vec3> now_m = groove.positions_m;
    for (Vec3& p : now_m) p.x() *= 1.0 - rate_1_s * time_s;
    return now_m;
  };
  ContactSettings settings = settings_with(0.0);
  SurfacePlayer player(groove, closing, settings);
  const double rest_m = settings.radius_m / std::sin(half_angle_rad);
  for (int tick = 0; tick < 60; ++tick) player.tick({Vec3(0, 0, rest_m + 1e-3 - 5e-5 * tick), Vec3::Zero()});
  ASSERT_GE(player.proxy.contact().bearing, 2);
  const double before_m = player.proxy.position_m().z();
  player.tick({Vec3(0, 0, rest_m - 2e-3), Vec3::Zero()});
  const double lifted_m_s = (player.proxy.position_m().z() - before_m) / 1e-3;
  EXPECT_GT(lifted_m_s, 1e-4);
  EXPECT_NEAR(player.proxy.contact().velocity_m_s.z(), lifted_m_s, 0.05 * lifted_m_s);
}

// The surface of a model that leads on is beyond the step's end by that share of its way, and stays there.
TEST(MovingSurface, LeadsOnByAShareOfTheStep) {
  const geometry::TriangleMesh plane = geometry::make_plane(0.04, 4);
  std::vector<Vec3> later_m = plane.positions_m;
  for (Vec3& p : later_m) p.z() += 1e-3;
  messages::LocalModel model;
  write_patch(plane, plane.positions_m, later_m, Vec3::Zero(), model);
  model.published_at_ns = 1'000'000;
  model.dt_ns = 10'000'000;
  MovingSurface surface;
  double before_m = 0.0;
  for (std::uint64_t tick = 1; tick <= 15; ++tick) {
    surface.begin_tick(model, tick * 1'000'000, tick == 1, 0.25);
    const double z_m = surface.corner_m(0, 0, 1.0).z();
    EXPECT_LE(z_m, 1.25e-3 + 1e-12);
    EXPECT_GE(z_m, before_m);
    before_m = z_m;
  }
  EXPECT_NEAR(before_m, 1.25e-3, 1e-12);
}

}  // namespace
}  // namespace myotact::haptics
