// The smooth skin over triangles: against the ball that they stand for, and against the laws that keep it harmless.

#include "haptics/proxy/curved_surface.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/closest_point.h"
#include "haptics/haptic_loop.h"
#include "haptics/surface_player.h"

namespace myotact::haptics {
namespace {

/// The surface of one model at rest.
struct Still {
  Still(const geometry::TriangleMesh& mesh, const Vec3& centre_m) {
    write_patch(mesh, mesh.positions_m, mesh.positions_m, centre_m, model);
    model.dt_ns = 10'000'000;
    surface.begin_tick(model, 0, true);
  }
  NearestPoint on_triangle(int local, const Vec3& p_m) const {
    const geometry::TrianglePoint found = geometry::closest_point_on_triangle(
        p_m, surface.corner_m(local, 0, 1.0), surface.corner_m(local, 1, 1.0), surface.corner_m(local, 2, 1.0));
    return {local, (p_m - found.position_m).norm(), found.position_m, found.barycentric};
  }
  NearestPoint on_skin(CurvedSurface& skin, const Vec3& p_m) const {
    NearestPoint best;
    best.distance_m = 1.0;
    for (int local = 0; local < surface.triangle_count(); ++local) {
      const NearestPoint here = skin.nearest(on_triangle(local, p_m), p_m);
      if (here.distance_m < best.distance_m) best = here;
    }
    return best;
  }
  messages::LocalModel model;
  MovingSurface surface;
};

/// Points 3 mm outside of a ball of 25 mm, within 30 degrees of the z axis.
std::vector<Vec3> places_above(double distance_m) {
  std::vector<Vec3> places_m;
  for (int i = 0; i < 400; ++i) {
    const double tilt = 0.5 * std::sqrt((i + 0.5) / 400.0), turn = 2.399963 * i;  // sunflower
    places_m.push_back(distance_m *
                       Vec3(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)));
  }
  return places_m;
}

TEST(CurvedSurface, IsNearerToTheBallThanItsTriangles) {
  const double radius_m = 0.025;
  const Still still(geometry::make_ball(radius_m, 3), Vec3(0, 0, radius_m));
  CurvedSurface skin(1e-3);
  skin.begin_tick(still.surface);
  double worst_m = 0.0, worst_flat_m = 0.0;
  for (const Vec3& p_m : places_above(0.028)) {
    double flat_m = 1.0;
    for (int local = 0; local < still.surface.triangle_count(); ++local)
      flat_m = std::min(flat_m, still.on_triangle(local, p_m).distance_m);
    const double felt_m = still.on_skin(skin, p_m).distance_m;
    EXPECT_LE(felt_m, flat_m + 1e-12);  // never below the triangles
    worst_m = std::max(worst_m, std::abs(felt_m - 3e-3));
    worst_flat_m = std::max(worst_flat_m, std::abs(flat_m - 3e-3));
  }
  EXPECT_LT(worst_m, 0.1 * worst_flat_m);
}

TEST(CurvedSurface, ItsNormalTurnsAsTheBallsDoes) {
  const Still still(geometry::make_ball(0.025, 3), Vec3(0, 0, 0.025));
  CurvedSurface skin(1e-3);
  skin.begin_tick(still.surface);
  for (const Vec3& p_m : places_above(0.028)) {
    const Vec3 normal = (p_m - still.on_skin(skin, p_m).point_m).normalized();
    EXPECT_GT(normal.dot(p_m.normalized()), std::cos(0.02)) << p_m.transpose();  // triangles tilt by up to 0.08
  }
}

TEST(CurvedSurface, RidgesStayRidges) {
  const Still still(geometry::make_box(Vec3(0.02, 0.02, 0.02), 4), Vec3(0.009, 0, 0.01));
  CurvedSurface skin(1e-3);
  skin.begin_tick(still.surface);
  for (int local = 0; local < still.surface.triangle_count(); ++local) EXPECT_EQ(skin.height_m(local), 0.0);
}

TEST(CurvedSurface, TrianglesWithoutAreaDoNoHarm) {
  geometry::TriangleMesh mesh = geometry::make_ball(0.025, 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 4) mesh.triangles[t][1] = mesh.triangles[t][0];
  const Still still(mesh, Vec3(0, 0, 0.025));
  CurvedSurface skin(1e-3);
  skin.begin_tick(still.surface);
  for (const Vec3& p_m : places_above(0.028)) {
    const NearestPoint point = still.on_skin(skin, p_m);
    EXPECT_TRUE(point.point_m.allFinite());
    EXPECT_LT(point.distance_m, 0.01);
  }
}

/// Goes round a closed way without friction, 4 mm deep with a sphere of 1 mm, and adds up what the hand gains.
TEST(CurvedSurface, GivesNoEnergyOnAClosedWay) {
  const geometry::TriangleMesh ball = geometry::make_ball(0.025, 2);
  ContactSettings settings;
  settings.radius_m = 1e-3;
  settings.static_friction = settings.dynamic_friction = 0.0;
  settings.damping_Ns_m = 0.0;
  SurfacePlayer player(
      ball, [&](double) { return ball.positions_m; }, settings);
  const auto way_m = [](double turn) {
    const Vec3 out(0.35 * std::cos(turn), 0.35 * std::sin(turn), 1.0);
    return Vec3(out.normalized() * (0.0245 + 2e-4 * std::sin(3.0 * turn)));
  };
  player.tick({Vec3(0.35, 0, 1.0).normalized() * 0.03, Vec3::Zero()});
  for (int tick = 0; tick < 20; ++tick) player.tick({way_m(0.0), Vec3::Zero()});
  constexpr int kTicks = 4000;
  double work_J = 0.0;
  Vec3 last_N = coupling_force_N(player.proxy, {way_m(0.0), Vec3::Zero()}, settings);
  double largest_N = 0.0;
  for (int tick = 1; tick <= kTicks; ++tick) {
    const auto turn = [](int t) { return 2.0 * 3.14159265358979 * t / kTicks; };
    const ProxyGoal goal{way_m(turn(tick)), Vec3::Zero()};
    player.tick(goal);
    const Vec3 force_N = coupling_force_N(player.proxy, goal, settings);
    work_J += 0.5 * (force_N + last_N).dot(goal.position_m - way_m(turn(tick - 1)));  // trapezoids
    largest_N = std::max(largest_N, force_N.norm());
    last_N = force_N;
  }
  EXPECT_GT(largest_N, 1.0);
  EXPECT_LT(std::abs(work_J), 2e-6);  // of 1 mJ that the spring holds
}

}  // namespace
}  // namespace myotact::haptics
