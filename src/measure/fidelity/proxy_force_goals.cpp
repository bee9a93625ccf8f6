#include "measure/fidelity/proxy_force_goals.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "geometry/plain_surfaces.h"
#include "geometry/triangle_tree.h"
#include "measure/fidelity/shapes.h"
#include "measure/probe/surface_touch.h"

namespace myotact::measure {

namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;
constexpr double kBall_m = 0.025;

struct Slide {
  int levels = 3;
  double radius_m = 3e-3;
  double friction = 0.0;
  double depth_m = 1.5e-3;
  double sway_m_s = 0.0;  // of the whole surface, at most
};

/// The largest change of the force within a tick on great circles round a ball, with the device at a fixed depth.
double largest_step_N(const Slide& slide, int ticks) {
  const geometry::TriangleMesh ball = geometry::make_ball(kBall_m, slide.levels);
  haptics::ContactSettings contact;
  contact.radius_m = slide.radius_m;
  contact.static_friction = contact.dynamic_friction = slide.friction;
  const auto touch = std::make_unique<SurfaceTouch>(ball, contact);
  const Vec3 first = Vec3(1.0, 0.31, -0.23).normalized();
  const Vec3 second = first.cross(Vec3(0.2, 1.0, 0.57)).normalized();
  const double far_m = kBall_m + slide.radius_m - slide.depth_m;
  std::vector<Vec3> moved_m = ball.positions_m;
  double worst_N = 0.0;
  Vec3 last_N = Vec3::Zero();
  for (int tick = 1; tick <= ticks; ++tick) {
    const std::uint64_t now_ns = kTick_ns * static_cast<std::uint64_t>(tick);
    const double frequency_rad_s = 2.0 * 3.14159265358979323846;  // 1 Hz
    if (tick % 10 == 1 && slide.sway_m_s > 0.0) {
      const double sway_m = slide.sway_m_s / frequency_rad_s * std::sin(frequency_rad_s * 1e-3 * tick);
      for (std::size_t i = 0; i < moved_m.size(); ++i) moved_m[i] = ball.positions_m[i] + Vec3(0, 0, sway_m);
      touch->move_to(moved_m, now_ns - kTick_ns, 10 * kTick_ns);
    }
    const double angle_rad = 5e-5 * tick / kBall_m;  // 50 mm/s
    const Vec3 way = std::cos(angle_rad) * first + std::sin(angle_rad) * second;
    const double settle_m = tick <= 50 ? (slide.depth_m + 1e-3) * (1.0 - tick / 50.0) : 0.0;
    const haptics::ProxyGoal goal{way * (far_m + settle_m), Vec3::Zero()};
    touch->tick(goal, now_ns);
    const Vec3 force_N = touch->force_N(goal);
    if (tick > 60) worst_N = std::max(worst_N, (force_N - last_N).norm());
    last_N = force_N;
  }
  return worst_N;
}

/// Presses at random places of a bumpy ball, sliding.
double deepest_sphere(int presses) {
  geometry::TriangleMesh bumpy = geometry::make_ball(kBall_m, 4);
  swell(geometry::make_ball(kBall_m, 4), {}, 0.0, bumpy.positions_m);
  const geometry::TriangleTree tree(bumpy);
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  const auto touch = std::make_unique<SurfaceTouch>(bumpy, haptics::ContactSettings{});
  double deepest = 0.0;
  std::uint64_t now_ns = 1'000'000'000;
  for (int press = 0; press < presses; ++press) {
    haptics::ContactSettings contact;
    contact.radius_m = 0.5e-3 + 4.5e-3 * unit(random);
    contact.static_friction = contact.dynamic_friction = 0.5 * unit(random);
    touch->restart(contact);
    const Vec3 way = Vec3(normal(random), normal(random), normal(random)).normalized();
    const Vec3 across = way.unitOrthogonal();
    for (int tick = 0; tick < 60; ++tick) {
      const double out_m = kBall_m + 6e-3 + contact.radius_m - 2e-4 * tick;
      touch->tick({out_m * way + 5e-5 * tick * across, Vec3::Zero()}, now_ns += kTick_ns);
      const double clear_m = tree.nearest(touch->proxy().position_m(), bumpy.positions_m).distance_m;
      deepest = std::max(deepest, (contact.radius_m - clear_m) / contact.radius_m);
    }
  }
  return deepest;
}

/// On a plane the device's depth is force over stiffness. The largest share that it is off.
double worst_depth() {
  const geometry::TriangleMesh plane = geometry::make_plane(0.06, 13);
  double worst = 0.0;
  for (const double radius_m : {0.5e-3, 3e-3, 5e-3}) {
    for (const double depth_m : {0.2e-3, 1e-3, 5e-3}) {
      haptics::ContactSettings contact;
      contact.radius_m = radius_m;
      const auto touch = std::make_unique<SurfaceTouch>(plane, contact);
      std::uint64_t now_ns = 1'000'000'000;
      touch->tick({Vec3(1e-3, 2e-3, 0.01), Vec3::Zero()}, now_ns += kTick_ns);
      const haptics::ProxyGoal goal{Vec3(1e-3, 2e-3, radius_m - depth_m), Vec3::Zero()};
      for (int tick = 0; tick < 50; ++tick) touch->tick(goal, now_ns += kTick_ns);
      worst = std::max(worst, std::abs(touch->force_N(goal).z() / contact.stiffness_N_m / depth_m - 1.0));
    }
  }
  return worst;
}

}  // namespace

GoalFigures measure_force_steps(Effort effort) {
  GoalFigures result;
  const int ticks = effort == Effort::Full ? 12'000 : 3'200;  // 50 mm/s: once round the ball in 3142
  const auto add = [&](const std::string& what, const Slide& slide) {
    result.figures.push_back({what, 1e3 * largest_step_N(slide, ticks), "mN", 30.0});
  };
  add("ball of 1280 triangles", {3});
  add("ball of 320 triangles", {2});
  add("ball of 5120 triangles, sphere of 5 mm", {4, 5e-3});
  add("ball of 1280 triangles, sphere of 1 mm", {3, 1e-3});
  add("ball of 1280 triangles, friction 0.3", {3, 3e-3, 0.3});
  add("ball of 1280 triangles, swaying at 10 mm/s", {3, 3e-3, 0.0, 1.5e-3, 0.01});
  result.note =
      "50 mm/s, 1.5 mm deep, 800 N/m, a ball of 25 mm; of the true ball the direction alone changes by 2.4 mN";
  return result;
}

GoalFigures measure_penetration(Effort effort) {
  GoalFigures result;
  result.figures = {
      {"sphere in the triangles, of its radius", deepest_sphere(effort == Effort::Full ? 4'000 : 100), "", 1e-3},
      {"device depth off force over stiffness", 100.0 * worst_depth(), "%", 2.0}};
  result.note = "presses that slide over a bumpy ball of 5120 triangles, radius 0.5-5 mm; depth on a plane";
  return result;
}

}  // namespace myotact::measure
