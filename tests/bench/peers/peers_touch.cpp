// A tick of our proxy beside one of a plain god-object over Bullet's tree: the same surface, still or breathing, the
// same path of the device, no friction. Prints a table in Markdown.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "geometry/depth_inside.h"
#include "geometry/plain_surfaces.h"
#include "geometry/triangle_tree.h"
#include "god_object.h"
#include "measure/fidelity/shapes.h"
#include "measure/probe/surface_touch.h"
#include "realtime/period_histogram.h"

namespace myotact::peers {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;
constexpr int kTicks = 20'000;
constexpr int kTicksOfStep = 10;
constexpr double kDeep_m = 2e-3;
constexpr double kTravel_m = 1e-4;  // a tick: 100 mm/s
constexpr double kBreath = 0.03;    // of the size, to each side
constexpr double kBreath_Hz = 2.0;

struct Case {
  std::string name;
  geometry::TriangleMesh mesh;
  bool breathes = false;
  std::vector<Vec3> path_m;  // of the device
};

/// Round the longest axis, kDeep_m below the surface at rest, at constant speed.
std::vector<Vec3> helix(const geometry::TriangleMesh& mesh) {
  const geometry::TriangleTree tree(mesh);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.positions_m) box.extend(x);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::vector<Vec3> path_m;
  for (int tick = 0; tick < kTicks; ++tick) {
    Vec3 from_m = box.center();
    from_m[axis] += 0.3 * std::sin(2e-4 * tick) * box.sizes()[axis];
    const double angle = tick * kTravel_m / 0.025;
    from_m[(axis + 1) % 3] += 0.05 * std::cos(angle);
    from_m[(axis + 2) % 3] += 0.05 * std::sin(angle);
    const geometry::SurfacePlace place = tree.nearest(from_m, mesh.positions_m);
    const Vec3 out = (from_m - place.point.position_m).normalized();
    const Vec3 wanted_m = place.point.position_m - kDeep_m * out;
    if (path_m.empty()) {
      path_m.push_back(wanted_m + 3.0 * kDeep_m * out);
      continue;
    }
    const Vec3 way_m = wanted_m - path_m.back();
    path_m.push_back(path_m.back() + way_m * std::min(1.0, kTravel_m / std::max(way_m.norm(), 1e-12)));
  }
  return path_m;
}

std::vector<Vec3> breathed(const Case& what, int tick) {
  if (!what.breathes) return what.mesh.positions_m;
  Vec3 centre_m = Vec3::Zero();
  for (const Vec3& x : what.mesh.positions_m) centre_m += x / static_cast<double>(what.mesh.positions_m.size());
  const double scale = 1.0 + kBreath * std::sin(2.0 * std::numbers::pi * kBreath_Hz * 1e-3 * tick);
  std::vector<Vec3> result;
  for (const Vec3& x : what.mesh.positions_m) result.push_back(centre_m + scale * (x - centre_m));
  return result;
}

struct Felt {
  realtime::PeriodHistogram ticks, refits;
  int looked = 0, inside = 0;
  std::uint64_t rescues = 0;
};

int ticks_between_looks(const Case& what) {
  return what.mesh.triangles.size() < 20'000 ? 5 : 50;
}

void print(const Case& what, const std::string& program, const Felt& felt) {
  const realtime::DurationSummary tick = felt.ticks.summary(), refit = felt.refits.summary();
  fmt::print("| {}, {} | {} | {} | {:.2f} | {:.2f} | {:.1f} | {} of {} | {} |\n", what.name, what.mesh.triangles.size(),
             what.breathes ? "breathes" : "still", program, 1e-3 * static_cast<double>(tick.p50_ns),
             1e-3 * static_cast<double>(tick.p99_ns), 1e-3 * static_cast<double>(refit.p50_ns), felt.inside,
             felt.looked, felt.rescues);
  std::fflush(stdout);
}

std::uint64_t time_ns(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return static_cast<std::uint64_t>((std::chrono::steady_clock::now() - begin).count());
}

/// Found inside, it is put outside by the nearest way, so that each fall counts once.
void with_god_object(const Case& what) {
  const auto felt = std::make_unique<Felt>();
  GodObject point(what.mesh);
  geometry::TriangleTree tree(what.mesh);
  point.place(what.path_m.front());
  std::vector<Vec3> now_m = what.mesh.positions_m;
  for (int tick = 1; tick < kTicks; ++tick) {
    if (tick % kTicksOfStep == 0 && what.breathes) {
      now_m = breathed(what, tick);
      felt->refits.add(time_ns([&] { point.move_surface(now_m); }));
    }
    felt->ticks.add(time_ns([&] { point.tick(what.path_m[static_cast<std::size_t>(tick)]); }));
    if (tick % ticks_between_looks(what) != 0) continue;
    ++felt->looked;
    if (geometry::winding_number(what.mesh, now_m, point.position_m()) < 0.5) continue;
    ++felt->inside;
    tree.refit(now_m);
    const Vec3 outside_m = tree.nearest(point.position_m(), now_m).point.position_m;
    point.place(outside_m + 2e-5 * (outside_m - point.position_m()).normalized());
  }
  print(what, "god-object, Bullet's tree", *felt);
}

void with_proxy(const Case& what, double radius_m) {
  const auto felt = std::make_unique<Felt>();
  haptics::ContactSettings contact;
  contact.radius_m = radius_m;
  contact.static_friction = contact.dynamic_friction = 0.0;
  contact.stiffness_N_m = 500.0;
  const auto touch = std::make_unique<measure::SurfaceTouch>(what.mesh, contact);
  for (int tick = 1; tick < kTicks; ++tick) {
    const std::uint64_t now_ns = kTick_ns * static_cast<std::uint64_t>(tick);
    if (tick % kTicksOfStep == 0) {
      touch->move_to(breathed(what, tick), now_ns, kTicksOfStep * kTick_ns);
      felt->refits.add(touch->last_refit_ns());
    }
    touch->tick({what.path_m[static_cast<std::size_t>(tick)], Vec3::Zero()}, now_ns);
    felt->ticks.add(touch->tick_duration_ns());
    if (tick % ticks_between_looks(what) != 0) continue;
    ++felt->looked;
    if (geometry::winding_number(what.mesh, touch->positions_m(), touch->proxy().position_m()) >= 0.5) ++felt->inside;
  }
  felt->rescues = touch->proxy().counters().rescues;
  print(what, fmt::format("our proxy, radius {:g} mm", 1e3 * radius_m), *felt);
}

void run() {
  std::vector<measure::NamedShape> shapes = measure::canine_shapes();
  if (shapes.size() < 2) {
    shapes = {{"ball", geometry::make_ball(0.03, 3)}, {"ball", geometry::make_ball(0.03, 5)}};
  } else {
    shapes = {{shapes[1].name, shapes[1].mesh},
              {shapes[0].name + " x16", geometry::refined(shapes[0].mesh, 2)},
              {shapes[1].name + " x64", geometry::refined(shapes[1].mesh, 3)}};
  }
  fmt::print(
      "## A haptic tick\n\n| surface, triangles | | program | us a tick, p50 | p99 | refit p50, us | inside | put "
      "outside by "
      "itself |\n|---|---|---|---|---|---|---|---|\n");
  for (const measure::NamedShape& shape : shapes) {
    for (const bool breathes : {false, true}) {
      const Case what{shape.name, shape.mesh, breathes, helix(shape.mesh)};
      with_god_object(what);
      with_proxy(what, 0.0);
      with_proxy(what, 2e-3);
    }
  }
}

}  // namespace
}  // namespace myotact::peers

int main() {
  try {
    myotact::peers::run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
