#include "haptics/effects/texture.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/allocation_guard.h"

namespace myotact::haptics {
namespace {

constexpr double kTick_s = 1e-3;
constexpr double kStiffness_N_m = 800.0;

/// Two triangles in the plane z = 0 that share the edge x = 0: muscle, fibres along `left` on x < 0 and `right` on x >
/// 0.
messages::LocalModel two_triangles(const Vec3& left, const Vec3& right) {
  messages::LocalModel model;
  model.vertex_count = 4;
  model.triangle_count = 2;
  const std::array<Vec3, 4> corners = {Vec3(0, -1, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0)};
  for (std::size_t i = 0; i < 4; ++i) model.previous_world_m[i] = model.current_world_m[i] = to_array(corners[i]);
  const auto set = [&](std::size_t i, std::array<std::int32_t, 3> vertices, const Vec3& fibre) {
    const Vec3 a = corners[static_cast<std::size_t>(vertices[1])] - corners[static_cast<std::size_t>(vertices[0])];
    const Vec3 b = corners[static_cast<std::size_t>(vertices[2])] - corners[static_cast<std::size_t>(vertices[0])];
    Eigen::Matrix2d edges;
    edges << a.x(), b.x(), a.y(), b.y();
    const Eigen::Vector2d share = edges.inverse() * fibre.head<2>();
    model.triangles[i] = {0, static_cast<std::int32_t>(i), vertices, {}};
    model.triangles[i].tissue.fibre_edges = {static_cast<float>(share.x()), static_cast<float>(share.y())};
  };
  set(0, {0, 1, 2}, right);
  set(1, {0, 2, 3}, left);
  return model;
}

TextureSettings settings_of(const TextureSet& set) {
  TextureSettings settings;
  settings.by_tissue[0] = set;
  return settings;
}

/// A tool at known depth on known tissue, without a proxy between.
struct Hand {
  Hand(const TextureSet& set, const Vec3& left, const Vec3& right)
      : model(two_triangles(left, right)), texture(settings_of(set)) {
    surface.begin_tick(model, 1, true);
  }
  explicit Hand(const TextureSet& set) : Hand(set, Vec3::UnitX(), Vec3::UnitX()) {}

  /// `place_m`: z is minus the depth.
  Vec3 at(const Vec3& place_m, const Vec3& tissue_m_s = Vec3::Zero()) {
    ProxyContact contact;
    contact.active = place_m.z() < 0.0;
    contact.surface = 0;
    contact.triangle = place_m.x() > 0.0 ? 0 : 1;
    contact.velocity_m_s = tissue_m_s;
    contact.sliding = true;
    TextureTouch touch;
    touch.device = {place_m, started ? Vec3((place_m - last_m) / kTick_s) : Vec3::Zero()};
    touch.normal_N = std::max(0.0, -kStiffness_N_m * place_m.z());
    touch.stiffness_N_m = kStiffness_N_m;
    last_m = place_m;
    started = true;
    return texture.tick_N(surface, contact, touch);
  }

  messages::LocalModel model;
  MovingSurface surface;
  Texture texture;
  Vec3 last_m = Vec3::Zero();
  bool started = false;
};

TextureSet grooves() {
  TextureSet set;
  set.relief = {{2e-3, 0.5 * std::numbers::pi, 1e-5, 0.3}, {3.1e-3, 0.4, 5e-6, 1.0}};
  return set;
}

TEST(Relief, SlopeIsTheDerivativeOfTheHeight) {
  const TextureSet set = grooves();
  const auto height_m = [&](double u, double v) { return relief_at(set.relief, {u, v}, {0, 0}, kTick_s).height_m; };
  for (const double u : {0.0, 0.7e-3, 2.2e-3}) {
    for (const double v : {0.1e-3, 1.3e-3}) {
      const ReliefPoint at = relief_at(set.relief, {u, v}, {0, 0}, kTick_s);
      const double h = 1e-7;
      EXPECT_NEAR(at.slope.x(), (height_m(u + h, v) - height_m(u - h, v)) / (2 * h), 1e-7);
      EXPECT_NEAR(at.slope.y(), (height_m(u, v + h) - height_m(u, v - h)) / (2 * h), 1e-7);
    }
  }
}

TEST(Relief, WavesFasterThanTheCapAreGone) {
  const std::array wave = {ReliefWave{1e-3, 0.0, 1e-5, 0.0}};
  EXPECT_DOUBLE_EQ(relief_at(wave, {0, 0}, {0.19, 0}, kTick_s).height_m, 1e-5);  // 190 Hz
  EXPECT_NEAR(relief_at(wave, {0, 0}, {0.25, 0}, kTick_s).height_m, 0.5e-5, 1e-12);
  EXPECT_DOUBLE_EQ(relief_at(wave, {0, 0}, {0.31, 0}, kTick_s).height_m, 0.0);
  EXPECT_DOUBLE_EQ(relief_at(wave, {0, 0}, {0, 9.0}, kTick_s).height_m, 1e-5);  // along its crests
  EXPECT_DOUBLE_EQ(relief_at(wave, {0, 0}, {0.19, 0}, 2e-3).height_m, 0.0);     // 0.38 of a wave a tick
}

TEST(Texture, GroovesAreFeltAcrossTheFibresOnly) {
  TextureSet set;
  set.relief = {{2e-3, 0.5 * std::numbers::pi, 1e-5, 0.0}};
  double largest_across_N = 0.0, spread_along_N = 0.0;
  Hand across(set), along(set);
  const double start_N = along.at({0.01, 0, -1e-3}).z();
  for (int tick = 1; tick < 400; ++tick) {
    largest_across_N = std::max(largest_across_N, across.at({0.01, 2e-5 * tick, -1e-3}).tail<2>().norm());
    spread_along_N = std::max(spread_along_N, std::abs(along.at({0.01 + 2e-5 * tick, 0, -1e-3}).z() - start_N));
  }
  // N h' and K h at the largest: 0.8 N and 8 mN
  EXPECT_NEAR(largest_across_N, 0.8 * 1e-5 * std::numbers::pi * 1e3, 1e-3);
  EXPECT_LT(spread_along_N, 1e-9);
}

/// The relief is the slope of (K/2) (depth + h)^2: with the coupling's own K depth, a round trip costs nothing.
TEST(Texture, ReliefGivesBackWhatItTakes) {
  Hand hand(grooves());
  constexpr int kTicks = 20'000;
  double work_J = 0.0, moved_J = 0.0;
  Vec3 last_N = Vec3::Zero(), last_m = Vec3::Zero();
  for (int tick = 0; tick <= kTicks; ++tick) {
    const double turn = 2.0 * std::numbers::pi * tick / kTicks;
    const Vec3 place_m(0.02 + 4e-3 * std::sin(turn), 3e-3 * std::sin(2.0 * turn),
                       -1e-3 - 0.4e-3 * std::sin(3.0 * turn));
    const Vec3 force_N = hand.at(place_m);
    if (tick > 0) {
      const double step_J = 0.5 * (force_N + last_N).dot(place_m - last_m);
      work_J += step_J;
      moved_J += std::abs(step_J);
    }
    last_N = force_N;
    last_m = place_m;
  }
  EXPECT_GT(moved_J, 1e-5);
  EXPECT_LT(std::abs(work_J), 1e-3 * moved_J);
}

TEST(Texture, RidesOnMovingTissue) {
  Hand hand(grooves());
  const Vec3 tissue_m_s(0.03, -0.02, 0.0);
  const Vec3 start_m(0.01, 0.0, -1e-3);
  const Vec3 first_N = hand.at(start_m, tissue_m_s);
  for (int tick = 1; tick < 300; ++tick) {
    ASSERT_NEAR((hand.at(start_m + kTick_s * tick * tissue_m_s, tissue_m_s) - first_N).norm(), 0.0, 1e-9);
  }
}

TEST(Texture, NothingJumpsWhereFibresTurn) {
  Hand hand(grooves(), Vec3(1, 0, 0), Vec3(-0.8, 0.6, 0).normalized());  // also with the other sign
  Vec3 last_N = hand.at({-4e-3, 0, -1e-3});
  double largest_N = 0.0;
  for (int tick = 1; tick < 800; ++tick) {
    const Vec3 force_N = hand.at({-4e-3 + 1e-5 * tick, 2e-6 * tick, -1e-3});
    // Only the direction of the slope turns in the one tick, by 37 degrees.
    largest_N = std::max(largest_N, std::abs(force_N.z() - last_N.z()));
    last_N = force_N;
  }
  EXPECT_LT(largest_N, 1e-3);
}

TEST(Texture, FlattensUnderPressureInsteadOfGrowingStiff) {
  TextureSet set;
  set.relief = {{0.5e-3, 0.5 * std::numbers::pi, 2e-5, 0.0}};  // N h'' at 4 N: 12.6 kN/m
  Hand hand(set);
  double steepest_N_m = 0.0, last_N = hand.at({0.01, 0, -5e-3}).y();
  for (int tick = 1; tick < 1000; ++tick) {
    const double force_N = hand.at({0.01, 2e-6 * tick, -5e-3}).y();
    steepest_N_m = std::max(steepest_N_m, std::abs(force_N - last_N) / 2e-6);
    last_N = force_N;
  }
  EXPECT_LT(steepest_N_m, 310.0);
  EXPECT_GT(steepest_N_m, 250.0);
}

TEST(Texture, VibrationDoesNoWorkOnTheSlide) {
  TextureSet set;
  set.vibration.force_N = {0.5};
  set.vibration.speed_m_s = {0.05};
  set.vibration.nodes = {{{}, 0.1}};
  Hand hand(set);
  double squares = 0.0;
  for (int tick = 0; tick < 4000; ++tick) {
    const Vec3 force_N = hand.at({0.01 + 1e-4 * tick, 5e-5 * tick, -1e-3});
    if (tick < 100) continue;
    ASSERT_NEAR(force_N.dot(Vec3(2, 1, 0)), 0.0, 1e-9);
    ASSERT_NEAR(force_N.z(), 0.0, 1e-12);
    squares += force_N.squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / 3900), 0.1, 0.01);
}

TEST(Texture, ATouchKnocksOnceInProportionToItsSpeed) {
  TextureSet set;
  set.knock = {100.0, 0.01, 2.0};
  for (const double speed_m_s : {0.05, 0.1}) {
    Hand hand(set);
    double largest_N = 0.0;
    double height_m = 10.01e-3;
    for (; height_m > 0.0; height_m -= speed_m_s * kTick_s) EXPECT_EQ(hand.at({0.01, 0, height_m}), Vec3::Zero());
    for (int tick = 0; tick < 100; ++tick) {
      largest_N = std::max(largest_N, hand.at({0.01, 0, height_m}).z());
    }
    // 2 v exp(-t / 10 ms) sin(2 pi 100 t) is largest at t = 2.25 ms: 0.789 of 2 v; samples are 1 ms apart
    EXPECT_NEAR(largest_N, 0.789 * 2.0 * speed_m_s, 0.04 * speed_m_s);
    EXPECT_LT(std::abs(hand.at({0.01, 0, height_m}).z()), 1e-4);
    hand.at({0.01, 0, 1e-4});  // a bounce of a tick
    EXPECT_LT(std::abs(hand.at({0.01, 0, -1e-4}).z()), 1e-4);
  }
}

TEST(Texture, WithoutContactNothingIsFelt) {
  TextureSet set = grooves();
  set.knock = {100.0, 0.01, 2.0};
  Hand hand(set);
  for (int tick = 0; tick < 10; ++tick) EXPECT_EQ(hand.at({0.01, 1e-4 * tick, 1e-3}), Vec3::Zero());
}

TEST(Texture, AllocatesNothing) {
  TextureSet set = grooves();
  set.knock = {100.0, 0.01, 2.0};
  set.vibration.force_N = {0.5};
  set.vibration.speed_m_s = {0.05};
  set.vibration.nodes = {{{}, 0.1}};
  Hand hand(set);
  const support::AllocationGuard guard;
  for (int tick = 0; tick < 1000; ++tick) hand.at({0.01 + 1e-4 * tick, 0, tick % 100 < 50 ? 1e-3 : -1e-3});
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace
}  // namespace myotact::haptics
