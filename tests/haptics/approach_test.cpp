// Random approaches of a tool to a surface that swells, shrinks and ripples: the proxy must never be found inside.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "haptics/surface_player.h"
#include "realtime/period_histogram.h"

namespace myotact::haptics {
namespace {

struct Swelling {
  double amplitude_m = 5e-3;
  double speed_m_s = 0.1;
  double phase = 0.0;
};

/// A bumpy ball of 25 mm whose radius follows a triangle wave of the given amplitude and speed.
SurfacePlayer::Shape swelling_shape(const geometry::TriangleMesh& ball, const Swelling& swelling) {
  return [&ball, swelling](double t) {
    const double cycle = swelling.speed_m_s * t / (4.0 * swelling.amplitude_m) + swelling.phase;
    const double wave = 4.0 * std::abs(cycle - std::floor(cycle + 0.5)) - 1.0;
    std::vector<Vec3> vertices_m = ball.positions_m;
    for (Vec3& v : vertices_m) {
      const Vec3 way = v.normalized();
      const double bump_m =
          1.5e-3 * std::sin(9.0 * way.x() + 2.0 * wave) * std::sin(7.0 * way.y()) * std::cos(8.0 * way.z());
      v += (swelling.amplitude_m * wave + bump_m) * way;
    }
    return vertices_m;
  };
}

constexpr int kTrials = 10'000;

struct Tally {
  int inside = 0;
  std::uint64_t rescues = 0;
  std::uint64_t over_budget = 0;
  std::uint64_t ticks = 0;
};

Vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

/// One approach: from outside towards a place inside, then along and out again, at up to 1 m/s.
void approach(const geometry::TriangleMesh& ball, std::mt19937_64& random, Tally& tally,
              realtime::PeriodHistogram& durations) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Swelling swelling{5e-3, 5e-3 * std::pow(100.0, unit(random)), unit(random)};
  ContactSettings settings;
  settings.radius_m = 1e-3 + 4e-3 * unit(random);
  settings.static_friction = settings.dynamic_friction = 0.6 * unit(random);
  const double speed_m_s = 0.02 * std::pow(50.0, unit(random));
  SurfacePlayer player(ball, swelling_shape(ball, swelling), settings);
  const Vec3 way = random_direction(random);
  const Vec3 across = way.cross(random_direction(random)).normalized();
  const double gap_m = std::min(4e-3, 0.03 * speed_m_s);  // is crossed within 30 ticks
  const double start_m = 0.025 + swelling.amplitude_m + 1.5e-3 + settings.radius_m + gap_m;
  for (int tick = 0; tick < 60; ++tick) {
    const double travel_m = 1e-3 * speed_m_s * tick;
    const ProxyGoal goal{way * std::max(start_m - travel_m, 0.012) + across * 0.5 * travel_m, -speed_m_s * way};
    player.tick(goal);
    durations.add(player.tick_duration_ns);
    ++tally.ticks;
    if (tick % 10 == 9 && geometry::winding_number(ball, player.surface_now_m(), player.proxy.position_m()) > 0.5) {
      ++tally.inside;
      break;
    }
  }
  tally.rescues += player.proxy.counters().rescues;
  tally.over_budget += player.proxy.counters().over_budget;
}

TEST(ProxyApproach, NeverFallsThroughASwellingSurface) {
  const geometry::TriangleMesh ball = geometry::make_ball(0.025, 3);
  std::mt19937_64 random(20261121);
  Tally tally;
  realtime::PeriodHistogram durations;
  for (int trial = 0; trial < kTrials; ++trial) approach(ball, random, tally, durations);
  EXPECT_EQ(tally.inside, 0);
  EXPECT_LT(static_cast<double>(tally.rescues), 1e-4 * static_cast<double>(tally.ticks));
  const realtime::DurationSummary tick = durations.summary();
  RecordProperty("tick_p50_ns", std::to_string(tick.p50_ns));
  RecordProperty("tick_p99_ns", std::to_string(tick.p99_ns));
  std::printf("ticks %lu rescues %lu short of goal %lu; tick p50 %.1f p99 %.1f p99.9 %.1f  max %.1f us\n", tally.ticks,
              tally.rescues, tally.over_budget, 1e-3 * static_cast<double>(tick.p50_ns),
              1e-3 * static_cast<double>(tick.p99_ns), 1e-3 * static_cast<double>(tick.p999_ns),
              1e-3 * static_cast<double>(tick.max_ns));
}

}  // namespace
}  // namespace myotact::haptics
