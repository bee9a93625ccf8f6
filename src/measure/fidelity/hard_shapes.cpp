// Sheets, grooves, edges: measure_hard_shapes() of proxy_goals.h.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "geometry/plain_surfaces.h"
#include "measure/fidelity/proxy_goals.h"
#include "measure/fidelity/shapes.h"
#include "measure/probe/surface_touch.h"

namespace myotact::measure {

namespace {

using Random = std::mt19937_64;

constexpr std::uint64_t kTick_ns = 1'000'000;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Where the device is at a tick of a trial, 0 .. ticks.
using Way = std::function<Vec3(int tick)>;
/// Whether a proxy of this place has gone where it may not be.
using Lost = std::function<bool(const Vec3& proxy_m)>;

struct Tally {
  std::uint64_t ticks = 0;
  std::uint64_t lost = 0;
  std::uint64_t rescues = 0;
};

void run_way(SurfaceTouch& touch, int ticks, const Way& way, const Lost& lost, Tally& tally) {
  touch.restart(touch.contact());
  for (int tick = 0; tick <= ticks; ++tick) {
    const Vec3 here_m = way(tick);
    const Vec3 velocity_m_s = tick == 0 ? Vec3::Zero() : Vec3(1e3 * (here_m - way(tick - 1)));
    touch.tick({here_m, velocity_m_s}, kTick_ns * (tally.ticks + 1));
    ++tally.ticks;
    if (!lost(touch.proxy().position_m())) continue;
    ++tally.lost;
    break;
  }
  tally.rescues += touch.proxy().counters().rescues;
}

haptics::ContactSettings contact_of(double radius_m, double friction) {
  haptics::ContactSettings contact;
  contact.radius_m = radius_m;
  contact.static_friction = contact.dynamic_friction = friction;
  return contact;
}

/// Plunges 12 mm through a sheet at 0.1 to 2 m/s, wandering a little: the proxy must stay above its top.
void plunge_sheets(std::uint64_t ticks, Tally& tally) {
  Random random(2);
  const Tally before = tally;
  while (tally.ticks - before.ticks < ticks) {
    const double radius_m = between(random, 0.0, 1.0) < 0.3 ? 0.0 : between(random, 0.5e-3, 5e-3);
    const double half_m = 0.5 * std::array{2.0 * radius_m + 1e-4, 1e-3, 0.2e-3, 0.02e-3}[random() % 4];
    const geometry::TriangleMesh sheet =
        geometry::make_box(Vec3(0.06, 0.06, 2.0 * half_m), static_cast<int>(4 + random() % 20));
    SurfaceTouch touch(sheet, contact_of(radius_m, between(random, 0.0, 0.6)));
    for (int plunge = 0; plunge < 20; ++plunge) {
      const double speed_m_s = 0.1 * std::pow(20.0, between(random, 0.0, 1.0));
      const Vec3 start_m(between(random, -0.01, 0.01), between(random, -0.01, 0.01), half_m + radius_m + 5e-3);
      const Vec3 drift_m(between(random, -5e-5, 5e-5), between(random, -5e-5, 5e-5), -1e-3 * speed_m_s);
      const auto way = [&](int tick) {
        Vec3 here_m = start_m + std::min(tick, 100) * drift_m;
        here_m.z() = std::max(here_m.z(), -half_m - 0.012);
        return here_m;
      };
      run_way(
          touch, 150, way, [&](const Vec3& p_m) { return p_m.z() < half_m; }, tally);
    }
  }
}

/// Pokes into a groove to its bottom and beyond, across it and along it: the proxy must stay between the sides.
void poke_grooves(double opening_rad, std::uint64_t ticks, Tally& tally) {
  Random random(3);
  const double depth_m = 0.03;
  const double slope = std::tan(0.5 * opening_rad);
  const Tally before = tally;
  while (tally.ticks - before.ticks < ticks) {
    const geometry::TriangleMesh groove =
        geometry::make_groove(opening_rad, depth_m, static_cast<int>(3 + random() % 30));
    const double radius_m = between(random, 0.0, 1.0) < 0.3 ? 0.0 : between(random, 0.2e-3, 3e-3);
    SurfaceTouch touch(groove, contact_of(radius_m, between(random, 0.0, 0.5)));
    for (int poke = 0; poke < 20; ++poke) {
      const double speed_m_s = between(random, 0.02, 0.5);
      const double along_m = between(random, -0.008, 0.008), phase = between(random, 0.0, 6.0);
      const double swing_m = between(random, 0.0, 0.6 * depth_m * slope);  // not beyond the rim, where the surface ends
      const auto way = [&](int tick) {
        const double height_m = std::max(depth_m + 5e-3 - 1e-3 * speed_m_s * tick, -4e-3);
        return Vec3(swing_m * std::sin(0.05 * tick + phase), along_m + 3e-3 * std::sin(0.03 * tick), height_m);
      };
      // Above the rim, and beside it, is outside too.
      const auto lost = [&](const Vec3& p_m) {
        return std::abs(p_m.x()) > p_m.z() * slope + 1e-9 && p_m.z() < depth_m && std::abs(p_m.x()) < depth_m * slope;
      };
      run_way(touch, 300, way, lost, tally);
    }
  }
}

/// Goes round a cube 2 mm deep, over its edges and corners.
void slide_over_edges(std::uint64_t ticks, Tally& tally) {
  Random random(4);
  const double half_m = 0.01;
  const Tally before = tally;
  while (tally.ticks - before.ticks < ticks) {
    const geometry::TriangleMesh cube =
        geometry::make_box(Vec3::Constant(2.0 * half_m), static_cast<int>(1 + random() % 12));
    const double radius_m = between(random, 0.0, 1.0) < 0.2 ? 0.0 : between(random, 0.3e-3, 5e-3);
    SurfaceTouch touch(cube, contact_of(radius_m, between(random, 0.0, 0.6)));
    for (int round = 0; round < 10; ++round) {
      const Vec3 axis =
          Vec3(between(random, -1.0, 1.0), between(random, -1.0, 1.0), between(random, 0.1, 1.0)).normalized();
      const Vec3 first = axis.unitOrthogonal(), second = axis.cross(first);
      const double speed_m_s = between(random, 0.02, 0.5), phase = between(random, 0.0, 6.0);
      const double tilt = between(random, -0.5, 0.5);
      const auto way = [&](int tick) {
        const double angle = phase + speed_m_s * 1e-3 * tick / half_m;
        const Vec3 direction = std::cos(angle) * first + std::sin(angle) * second + tilt * axis;
        const double out_m = tick < 20 ? 1.3 * half_m + radius_m : half_m + radius_m - 2e-3;
        return Vec3(direction / direction.cwiseAbs().maxCoeff() * out_m);
      };
      run_way(
          touch, 400, way, [&](const Vec3& p_m) { return p_m.cwiseAbs().maxCoeff() < half_m; }, tally);
    }
  }
}

}  // namespace

GoalFigures measure_hard_shapes(Effort effort) {
  const std::uint64_t ticks = effort == Effort::Full ? 1'000'000 : 20'000;
  GoalFigures result;
  const auto report = [&](const std::string& what, const Tally& tally) {
    result.figures.push_back(
        {fmt::format("{}: fallen through in {} ticks", what, tally.ticks), static_cast<double>(tally.lost), "", 0.0});
    result.figures.push_back(
        {"rescues a tick of them", static_cast<double>(tally.rescues) / static_cast<double>(tally.ticks), "", 1e-4});
  };
  Tally sheets;
  plunge_sheets(ticks, sheets);
  report("sheets of twice the radius, 1, 0.2, 0.02 mm", sheets);
  for (const int degrees : {60, 30, 10}) {
    Tally grooves;
    poke_grooves(degrees * std::numbers::pi / 180.0, ticks, grooves);
    report(fmt::format("groove of {} degrees", degrees), grooves);
  }
  Tally edges;
  slide_over_edges(ticks, edges);
  report("edges and corners of a cube", edges);
  result.note = "radius 0 (a point) to 5 mm, device up to 2 m/s; friction 0 to 0.6";
  return result;
}

}  // namespace myotact::measure
