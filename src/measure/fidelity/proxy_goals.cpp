#include "measure/fidelity/proxy_goals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "geometry/depth_inside.h"
#include "geometry/plain_surfaces.h"
#include "measure/fidelity/shapes.h"
#include "measure/probe/surface_touch.h"

namespace myotact::measure {

namespace {

using Random = std::mt19937_64;

constexpr std::uint64_t kTick_ns = 1'000'000;
constexpr double kBall_m = 0.025;  // radius: a canine thigh muscle's belly
/// What the device must be in for a contact to count (the test frame by frame).
constexpr double kDeep_m = 2e-3;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Even in its logarithm.
double log_between(Random& random, double low, double high) {
  return low * std::pow(high / low, between(random, 0.0, 1.0));
}

Vec3 random_direction(Random& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

struct Tally {
  std::uint64_t trials = 0;
  std::uint64_t ticks = 0;
  std::uint64_t inside = 0;
  std::uint64_t rescues = 0;
  std::uint64_t without_room = 0;  // left out

  void count(const SurfaceTouch& touch) { rescues += touch.proxy().counters().rescues; }
  double rescue_share() const { return static_cast<double>(rescues) / std::max(1.0, static_cast<double>(ticks)); }
};

// ---- random approaches to a deforming surface

/// A ball of one fineness, with the touch that is restarted for each trial.
struct Ball {
  explicit Ball(int levels)
      : mesh(geometry::make_ball(kBall_m, levels)), positions_m(mesh.positions_m), touch(mesh, {}) {}

  geometry::TriangleMesh mesh;
  std::vector<Vec3> positions_m;
  SurfaceTouch touch;
};

struct Approach {
  Swelling swelling;
  haptics::ContactSettings contact;
  std::uint64_t frame_ns = 0;
  double speed_m_s = 0.0;
  double depth_m = 0.0;  // from the ball's centre, where the way in ends
  Vec3 way, across;
};

/// Goal 1's ranges; the tool's own speed goes to 1 m/s.
Approach random_approach(Random& random) {
  Approach approach;
  approach.swelling = {5e-3, log_between(random, 5e-3, 0.5), between(random, 0.0, 1.0), 1.5e-3};
  approach.contact.radius_m = between(random, 0.5e-3, 5e-3);
  approach.contact.static_friction = approach.contact.dynamic_friction = between(random, 0.0, 0.6);
  approach.frame_ns = static_cast<std::uint64_t>(1e9 / between(random, 60.0, 200.0));
  approach.speed_m_s = log_between(random, 0.02, 1.0);
  approach.depth_m = between(random, 0.012, 0.024);
  approach.way = random_direction(random);
  approach.across = approach.way.cross(random_direction(random)).normalized();
  return approach;
}

/// From outside towards a place inside and along the surface, while frames come at their own rate.
void run_approach(const Approach& approach, Ball& ball, std::uint64_t& now_ns, Tally& tally) {
  constexpr int kTicks = 60;
  constexpr int kCheckEvery = 5;
  SurfaceTouch& touch = ball.touch;
  touch.restart(approach.contact);
  const std::uint64_t start_ns = now_ns;
  std::uint64_t next_frame_ns = now_ns;
  const double gap_m = std::min(4e-3, 0.03 * approach.speed_m_s);  // is crossed within 30 ticks
  const double start_m =
      kBall_m + approach.swelling.amplitude_m + approach.swelling.bump_m + gap_m + approach.contact.radius_m;
  for (int tick = 1; tick <= kTicks; ++tick) {
    if (now_ns >= next_frame_ns) {
      const auto at_s = [&](std::uint64_t ns) { return 1e-9 * static_cast<double>(ns - start_ns); };
      std::vector<Vec3> from_m = ball.positions_m;
      if (tick == 1) swell(ball.mesh, approach.swelling, 0.0, from_m);
      next_frame_ns += approach.frame_ns;
      swell(ball.mesh, approach.swelling, at_s(next_frame_ns), ball.positions_m);
      touch.play(std::move(from_m), ball.positions_m, next_frame_ns - approach.frame_ns, approach.frame_ns);
    }
    now_ns += kTick_ns;
    const double travel_m = 1e-3 * approach.speed_m_s * tick;
    touch.tick({approach.way * std::max(start_m - travel_m, approach.depth_m) + approach.across * 0.5 * travel_m,
                -approach.speed_m_s * approach.way},
               now_ns);
    ++tally.ticks;
    if (tick % kCheckEvery != 0) continue;
    if (geometry::winding_number(ball.mesh, touch.positions_m(), touch.proxy().position_m()) > 0.5) {
      ++tally.inside;
      break;
    }
  }
  ++tally.trials;
  tally.count(touch);
}

Tally measure_approaches(std::uint64_t trials) {
  // Coarse triangles (14 mm) are many, fine ones (0.9 mm, below most radii) few: a trial on them takes 30 times as
  // long.
  constexpr std::array<int, 4> kLevels = {2, 3, 4, 5};
  constexpr std::array<double, 4> kUpTo = {0.55, 0.88, 0.99, 1.0};
  std::array<std::unique_ptr<Ball>, 4> balls;
  for (std::size_t i = 0; i < balls.size(); ++i) balls[i] = std::make_unique<Ball>(kLevels[i]);
  Random random(20261122);
  std::uint64_t now_ns = 1'000'000'000;
  Tally tally;
  for (std::uint64_t trial = 0; trial < trials; ++trial) {
    const double draw = between(random, 0.0, 1.0);
    const auto chosen = static_cast<std::size_t>(
        std::find_if(kUpTo.begin(), kUpTo.end(), [&](double up_to) { return draw < up_to; }) - kUpTo.begin());
    run_approach(random_approach(random), *balls[std::min(chosen, balls.size() - 1)], now_ns, tally);
  }
  return tally;
}

// ---- one frame

struct Place {
  Vec3 point_m, normal;
};

/// Even over the area.
std::vector<Place> random_places(const geometry::TriangleMesh& mesh, int count, Random& random) {
  std::vector<double> areas_m2;
  std::vector<Place> places;
  const auto corner = [&](std::size_t t, std::size_t k) {
    return mesh.positions_m[static_cast<std::size_t>(mesh.triangles[t][k])];
  };
  const auto area = [&](std::size_t t) {
    return Vec3(0.5 * (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)));
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) areas_m2.push_back(area(t).norm());
  std::discrete_distribution<std::size_t> draw(areas_m2.begin(), areas_m2.end());
  for (int i = 0; i < count; ++i) {
    const std::size_t t = draw(random);
    const double u = std::sqrt(between(random, 0.0, 1.0)), v = between(random, 0.0, 1.0);
    places.push_back(
        {(1.0 - u) * corner(t, 0) + u * (1.0 - v) * corner(t, 1) + u * v * corner(t, 2), area(t).normalized()});
  }
  return places;
}

/// One move of a surface: from the mesh's own places to others.
struct Move {
  const geometry::TriangleMesh& mesh;
  const std::vector<Vec3>& moved_m;
};

/// Whether there is outside, as far as the sphere's centre, over the touched point of the moved surface.
bool has_room(const Move& move, const haptics::ProxyContact& contact, double radius_m) {
  const auto& triangle = move.mesh.triangles[static_cast<std::size_t>(contact.triangle)];
  const auto corner = [&](std::size_t k) { return move.moved_m[static_cast<std::size_t>(triangle[k])]; };
  const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  Vec3 point_m = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) point_m += contact.barycentric[k] * corner(k);
  for (const double share : {0.01, 0.5, 1.0}) {
    if (geometry::winding_number(move.mesh, move.moved_m, point_m + share * radius_m * normal) > 0.5) return false;
  }
  return true;
}

/// Settles at the place, moves the surface once within one tick, waits 16 ticks. Left out: places without sound
/// contact, and those where the moved surface passes through itself (a cleft that closes), so that nothing is outside.
void run_frame(SurfaceTouch& touch, const Move& move, const Place& place, std::uint64_t& now_ns, Tally& tally) {
  const std::vector<Vec3>& rest_m = move.mesh.positions_m;
  constexpr int kSettle = 6;
  constexpr int kAfter = 16;
  const double radius_m = touch.contact().radius_m;
  touch.play(rest_m, rest_m, now_ns, kTick_ns);
  touch.restart(touch.contact());
  const haptics::ProxyGoal pressed{place.point_m + (radius_m - kDeep_m) * place.normal, Vec3::Zero()};
  touch.tick({place.point_m + (radius_m + 1e-3) * place.normal, Vec3::Zero()}, now_ns += kTick_ns);
  for (int tick = 0; tick < kSettle; ++tick) touch.tick(pressed, now_ns += kTick_ns);
  const haptics::ProxyContact contact = touch.proxy().contact();
  if (!contact.active || geometry::winding_number(move.mesh, rest_m, touch.proxy().position_m()) > 0.5) return;
  if (!has_room(move, contact, radius_m)) {
    ++tally.without_room;
    return;
  }
  touch.play(rest_m, move.moved_m, now_ns, kTick_ns);
  for (int tick = 0; tick < kAfter; ++tick) touch.tick(pressed, now_ns += kTick_ns);
  ++tally.trials;
  tally.ticks += kSettle + kAfter;
  tally.inside += geometry::winding_number(move.mesh, touch.positions_m(), touch.proxy().position_m()) > 0.5 ? 1 : 0;
  tally.count(touch);
}

Tally measure_frames(const geometry::TriangleMesh& mesh, int points) {
  const std::vector<Vec3> outward = geometry::vertex_normals(mesh);
  Random random(7);
  const std::vector<Place> places = random_places(mesh, points, random);
  std::uint64_t now_ns = 1'000'000'000;
  Tally tally;
  for (const double radius_m : {0.5e-3, 2e-3, 5e-3}) {
    haptics::ContactSettings contact;
    contact.radius_m = radius_m;
    SurfaceTouch touch(mesh, contact);
    for (const double delta_m : {0.1e-3, 1e-3, 2e-3, 5e-3}) {
      std::vector<Vec3> moved_m = mesh.positions_m;
      for (std::size_t i = 0; i < moved_m.size(); ++i) moved_m[i] += delta_m * outward[i];
      for (const Place& place : places) run_frame(touch, {mesh, moved_m}, place, now_ns, tally);
    }
  }
  return tally;
}

}  // namespace

GoalFigures measure_deforming_contact(Effort effort) {
  const bool full = effort == Effort::Full;
  GoalFigures result;
  const Tally approaches = measure_approaches(full ? 100'000 : 1'500);
  result.figures.push_back(
      {fmt::format("inside, of {} approaches", approaches.trials), static_cast<double>(approaches.inside), "", 0.0});
  result.figures.push_back({"rescues a tick of them", approaches.rescue_share(), "", 1e-4});
  std::vector<NamedShape> shapes = canine_shapes();
  geometry::TriangleMesh bumpy = geometry::make_ball(kBall_m, 3);
  swell(geometry::make_ball(kBall_m, 3), {}, 0.0, bumpy.positions_m);
  shapes.push_back({"bumpy ball", std::move(bumpy)});
  std::uint64_t rescues = 0;
  for (const NamedShape& shape : shapes) {
    const Tally frames = measure_frames(shape.mesh, full ? 1'000 : 25);
    result.figures.push_back(
        {fmt::format("inside, of {} single moves of the {}{}", frames.trials, shape.name,
                     frames.without_room == 0 ? "" : fmt::format(" ({} had no room)", frames.without_room)),
         static_cast<double>(frames.inside), "", 0.0});
    rescues += frames.rescues;
  }
  result.note = fmt::format(
      "approaches: 5-500 mm/s, 60-200 frames/s, radius 0.5-5 mm, edges 0.9-14 mm; single moves: 2 mm deep, then all "
      "vertices 0.1, 1, 2 or 5 mm outwards within 1 ms, radius 0.5, 2, 5 mm, {} rescues; no room: the moved surface "
      "passes through itself there",
      rescues);
  return result;
}

}  // namespace myotact::measure
