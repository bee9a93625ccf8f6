#include "measure/fidelity/proxy_cost_goals.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "geometry/plain_surfaces.h"
#include "measure/fidelity/shapes.h"
#include "measure/probe/surface_touch.h"
#include "realtime/period_histogram.h"
#include "realtime/periodic_loop.h"

namespace myotact::measure {

namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;
constexpr double kRadius_m = 2e-3;
constexpr double kDeep_m = 2e-3;
constexpr double kTravel_m = 1e-4;  // a tick: 100 mm/s

/// A surface of about this many triangles: a canine muscle cut finer, or a ball.
struct Sized {
  NamedShape shape;
  double p50_goal_us = 0.0, p99_goal_us = 0.0;
};

std::vector<Sized> sized_shapes() {
  const std::vector<NamedShape> canine = canine_shapes();
  if (canine.size() < 2) {
    return {{{"ball", geometry::make_ball(0.03, 3)}, 2.0, 10.0},
            {{"ball", geometry::make_ball(0.03, 5)}, 3.0, 15.0},
            {{"ball", geometry::make_ball(0.03, 6)}, 6.0, 25.0}};
  }
  return {{canine[1], 2.0, 10.0},
          {{canine[0].name + " x16", geometry::refined(canine[0].mesh, 2)}, 3.0, 15.0},
          {{canine[1].name + " x64", geometry::refined(canine[1].mesh, 3)}, 6.0, 25.0}};
}

/// A device that follows a helix round the longest axis of a surface, kDeep_m below it.
class Helix {
 public:
  explicit Helix(const geometry::TriangleMesh& mesh) : mesh_(mesh), tree_(mesh) {
    for (const Vec3& x : mesh.positions_m) box_.extend(x);
    box_.sizes().maxCoeff(&axis_);
  }

  Vec3 next_m() {
    const double along = 0.3 * std::sin(2e-4 * tick_++);  // of the length, there and back
    Vec3 from_m = box_.center();
    from_m[axis_] += along * box_.sizes()[axis_];
    Vec3 out = Vec3::Zero();
    out[(axis_ + 1) % 3] = std::cos(angle_rad_);
    out[(axis_ + 2) % 3] = std::sin(angle_rad_);
    angle_rad_ += kTravel_m / 0.025;
    const geometry::SurfacePlace place = tree_.nearest(from_m + 0.05 * out, mesh_.positions_m);
    const auto& triangle = mesh_.triangles[static_cast<std::size_t>(place.triangle)];
    const auto corner = [&](std::size_t k) { return mesh_.positions_m[static_cast<std::size_t>(triangle[k])]; };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    const Vec3 wanted_m = place.point.position_m + (kRadius_m - kDeep_m) * normal;
    if (tick_ == 1) return here_m_ = wanted_m + 2.0 * kDeep_m * normal;
    const Vec3 way_m = wanted_m - here_m_;
    if (way_m.norm() > 0.0) here_m_ += way_m * std::min(1.0, kTravel_m / way_m.norm());
    return here_m_;
  }

 private:
  const geometry::TriangleMesh& mesh_;
  geometry::TriangleTree tree_;
  Eigen::AlignedBox3d box_;
  Eigen::Index axis_ = 0;
  double angle_rad_ = 0.0;
  int tick_ = 0;
  Vec3 here_m_ = Vec3::Zero();
};

realtime::DurationSummary slide(const geometry::TriangleMesh& mesh, int ticks) {
  haptics::ContactSettings contact;
  contact.radius_m = kRadius_m;
  contact.static_friction = 0.5;
  contact.dynamic_friction = 0.4;
  contact.stiffness_N_m = 500.0;
  const auto touch = std::make_unique<SurfaceTouch>(mesh, contact);
  Helix helix(mesh);
  realtime::PeriodHistogram durations;
  for (int tick = 1; tick <= ticks; ++tick) {
    const std::uint64_t now_ns = kTick_ns * static_cast<std::uint64_t>(tick);
    if (tick % 10 == 0) touch->play(mesh.positions_m, mesh.positions_m, now_ns, 10 * kTick_ns);  // a model a step
    touch->tick({helix.next_m(), Vec3::Zero()}, now_ns);
    if (tick > 100) durations.add(touch->tick_duration_ns());
  }
  return durations.summary();
}

}  // namespace

GoalFigures measure_tick_cost(Effort effort) {
  GoalFigures result;
  for (const Sized& sized : sized_shapes()) {
    const realtime::DurationSummary tick = slide(sized.shape.mesh, effort == Effort::Full ? 100'000 : 3'000);
    const std::string what = fmt::format("{}, {} triangles, tick", sized.shape.name, sized.shape.mesh.triangles.size());
    result.figures.push_back(
        {what + " p50", 1e-3 * static_cast<double>(tick.p50_ns), "us", sized.p50_goal_us, false, true});
    result.figures.push_back(
        {what + " p99", 1e-3 * static_cast<double>(tick.p99_ns), "us", sized.p99_goal_us, false, true});
  }
  result.note =
      "100 mm/s, 2 mm deep, radius 2 mm, static friction 0.5, dynamic 0.4, 500 N/m; a new model every 10 ticks";
  return result;
}

GoalFigures measure_surface_update(Effort effort) {
  GoalFigures result;
  const int rounds = effort == Effort::Full ? 300 : 20;
  for (const auto& [levels, goal_ms] :
       {std::pair{4, 0.3 * 5120 / 1e4}, {5, 0.3 * 20480 / 1e4}, {6, 2.5 * 81920 / 1e5}}) {
    const geometry::TriangleMesh ball = geometry::make_ball(0.025, levels);
    const auto touch = std::make_unique<SurfaceTouch>(ball, haptics::ContactSettings{});
    realtime::PeriodHistogram refits, taking, resting;
    std::vector<Vec3> moved_m = ball.positions_m;
    std::uint64_t now_ns = 1'000'000'000;
    for (int round = 0; round < rounds; ++round) {
      for (Vec3& x : moved_m) x *= round % 2 == 0 ? 1.01 : 1.0 / 1.01;
      touch->play(touch->positions_m(), moved_m, now_ns, 10 * kTick_ns);
      refits.add(touch->last_refit_ns());
      for (int tick = 0; tick < 10; ++tick) {
        touch->tick({Vec3(0, 0, 0.0265), Vec3::Zero()}, now_ns += kTick_ns);
        if (round > 0) (tick == 0 ? taking : resting).add(touch->tick_duration_ns());
      }
    }
    const std::string what = fmt::format("{} triangles", ball.triangles.size());
    result.figures.push_back(
        {what + ", refit p50", 1e-6 * static_cast<double>(refits.summary().p50_ns), "ms", goal_ms, false, true});
    const double share_us =
        1e-3 * (static_cast<double>(taking.summary().p50_ns) - static_cast<double>(resting.summary().p50_ns));
    result.figures.push_back(
        {what + ", tick that takes a model over one that does not", share_us, "us", 1.0, false, true});
  }
  result.note = "goals of the refit are 0.3 ms for 10,000 triangles and 2.5 ms for 100,000, in proportion";
  return result;
}

}  // namespace myotact::measure
