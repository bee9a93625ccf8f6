// The comparison of a commanded with a true force against closed forms, and against faults planted into known forces.

#include "measure/fidelity/force_comparison.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/error.h"
#include "measure/fidelity/planted_faults.h"

namespace myotact::measure {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree_rad = kPi / 180.0;

std::vector<Vec3> sine(double amplitude_N, double frequency_Hz, std::size_t ticks, double late_s = 0.0) {
  std::vector<Vec3> force_N;
  for (std::size_t i = 0; i < ticks; ++i)
    force_N.emplace_back(amplitude_N * std::sin(2.0 * kPi * frequency_Hz * (1e-3 * static_cast<double>(i) - late_s)) *
                         Vec3::UnitX());
  return force_N;
}

/// Presses and strokes: touch for a second, 0.4 s of air, force up to 1 N that leans over while the tool slides.
std::vector<Vec3> presses(std::size_t ticks) {
  std::vector<Vec3> force_N;
  for (std::size_t i = 0; i < ticks; ++i) {
    const double t_s = 1e-3 * static_cast<double>(i % 1400);
    const double size_N = t_s < 1.0 ? std::pow(std::sin(kPi * t_s), 2) : 0.0;
    const double lean_rad = 0.3 * std::sin(2.0 * kPi * 1e-3 * static_cast<double>(i) / 3.1);
    force_N.emplace_back(size_N * Vec3(-std::cos(lean_rad), std::sin(lean_rad), 0.3));
  }
  return force_N;
}

TEST(ForceComparison, ALateSineDiffersByItsClosedForm) {
  constexpr double kLate_s = 4e-3, kFrequency_Hz = 5.0, kAmplitude_N = 1.5;
  const ForceSeries series{
      sine(kAmplitude_N, kFrequency_Hz, 10'000, kLate_s), sine(kAmplitude_N, kFrequency_Hz, 10'000), {}, {}};
  const ForceComparison found = compare_forces(series);
  const double half_rad = kPi * kFrequency_Hz * kLate_s;
  EXPECT_EQ(found.ticks, 10'000u);
  EXPECT_NEAR(found.true_rms_N, kAmplitude_N / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(found.error_rms_share, 2.0 * std::sin(half_rad), 1e-4);
  EXPECT_NEAR(found.error_worst_N, 2.0 * kAmplitude_N * std::sin(half_rad), 1e-3);
  EXPECT_NEAR(found.lag_s, kLate_s, 2e-6);
  EXPECT_NEAR(found.gain, 1.0, 1e-4);
}

TEST(ForceComparison, LagsBetweenTicksAndEarlyOnesAreFound) {
  for (const double late_s : {0.0004, 0.0025, 0.0177, -0.0033}) {
    const ForceComparison found = compare_forces({sine(1.0, 3.0, 8000, late_s), sine(1.0, 3.0, 8000), {}, {}});
    EXPECT_NEAR(found.lag_s, late_s, 2e-5) << late_s;
  }
}

TEST(ForceComparison, AGainIsFoundWhateverTheSize) {
  for (const double gain : {0.5, 0.9, 1.02, 3.0}) {
    std::vector<Vec3> commanded_N = presses(4200);
    for (Vec3& force_N : commanded_N) force_N *= gain;
    const ForceComparison found = compare_forces({commanded_N, presses(4200), {}, {}});
    EXPECT_NEAR(found.gain, gain, 1e-9);
    EXPECT_NEAR(found.error_rms_share, std::abs(gain - 1.0), 1e-9);
    EXPECT_NEAR(found.rotation_angle_rad(), 0.0, 1e-9);
  }
}

TEST(ForceComparison, ATurnIsFoundWithItsAxisAndSign) {
  const Vec3 rotation_rad(0.02, -0.3, 0.15);
  const Mat3 turn = Eigen::AngleAxisd(rotation_rad.norm(), rotation_rad.normalized()).toRotationMatrix();
  std::vector<Vec3> commanded_N;
  for (const Vec3& force_N : presses(4200)) commanded_N.emplace_back(turn * force_N);
  const ForceComparison found = compare_forces({commanded_N, presses(4200), {}, {}});
  EXPECT_LT((found.rotation_rad - rotation_rad).norm(), 1e-6);
}

TEST(ForceComparison, ForcesAlongOneLineTellNothingOfATurnAboutIt) {
  std::vector<Vec3> true_N = sine(1.0, 2.0, 4000), commanded_N;
  const Mat3 turn = Eigen::AngleAxisd(0.2, Vec3::UnitZ()).toRotationMatrix();
  for (const Vec3& force_N : true_N) commanded_N.emplace_back(turn * force_N);
  const ForceComparison found = compare_forces({commanded_N, true_N, {}, {}});
  EXPECT_LT((found.rotation_rad - 0.2 * Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(found.mean_angle_rad, 0.2, 1e-6);
}

TEST(ForceComparison, NoiseIsWhatLiesOver20Hz) {
  for (const auto& [frequency_Hz, seen] : {std::pair{4.0, 0.0}, {60.0, 1.0}, {200.0, 1.0}}) {
    std::vector<Vec3> commanded_N = presses(8400);
    const std::vector<Vec3> buzz_N = sine(0.05, frequency_Hz, 8400);
    for (std::size_t i = 0; i < commanded_N.size(); ++i) commanded_N[i] += buzz_N[i].x() * Vec3::UnitZ();
    const ForceComparison found = compare_forces({commanded_N, presses(8400), {}, {}});
    EXPECT_NEAR(found.noise_rms_N, seen * 0.05 / std::sqrt(2.0), 1.5e-3) << frequency_Hz;
  }
}

TEST(ForceComparison, TheSpectrumHasTheNoisesPowerAtItsFrequency) {
  std::vector<Vec3> commanded_N = sine(1.0, 1.0, 8192);
  const std::vector<Vec3> buzz_N = sine(0.1, 125.0, 8192);
  for (std::size_t i = 0; i < commanded_N.size(); ++i) commanded_N[i] += buzz_N[i];
  const std::vector<double> density = compare_forces({commanded_N, sine(1.0, 1.0, 8192), {}, {}}).noise_N2_Hz;
  ASSERT_EQ(density.size(), 129u);
  double power_N2 = 0.0;
  for (std::size_t bin = 30; bin <= 34; ++bin) power_N2 += density[bin] * 1000.0 / 256.0;  // 125 Hz is bin 32
  EXPECT_NEAR(power_N2, 0.5 * 0.01, 1e-4);
}

TEST(ForceComparison, ASpringThatAnswersLateGivesTheEnergyOfItsLoop) {
  // W = pi k X^2 sin(omega d) a cycle.
  constexpr double kSpring_N_m = 400.0, kReach_m = 5e-3, kFrequency_Hz = 2.0, kLate_s = 10e-3;
  const std::size_t ticks = 5001;  // ten whole cycles of ways
  std::vector<Vec3> hand_m, true_N, late_N;
  for (std::size_t i = 0; i < ticks; ++i) {
    const double angle_rad = 2.0 * kPi * kFrequency_Hz * 1e-3 * static_cast<double>(i);
    const double half_tick_rad = kPi * kFrequency_Hz * 1e-3;  // a force held over a way belongs to its middle
    hand_m.emplace_back(kReach_m * std::sin(angle_rad) * Vec3::UnitX());
    true_N.emplace_back(-kSpring_N_m * kReach_m * std::sin(angle_rad + half_tick_rad) * Vec3::UnitX());
    late_N.emplace_back(-kSpring_N_m * kReach_m *
                        std::sin(angle_rad + half_tick_rad - 2.0 * kPi * kFrequency_Hz * kLate_s) * Vec3::UnitX());
  }
  const ForceComparison found = compare_forces({late_N, true_N, hand_m, {}});
  EXPECT_NEAR(found.true_work_J, 0.0, 1e-6);
  const double loop_J = kPi * kSpring_N_m * kReach_m * kReach_m * std::sin(2.0 * kPi * kFrequency_Hz * kLate_s);
  EXPECT_NEAR(found.commanded_work_J, 10.0 * loop_J, 1e-3 * 10.0 * loop_J);
}

TEST(ForceComparison, TicksThatAreNotJudgedChangeNothing) {
  std::vector<Vec3> commanded_N = presses(4200);
  std::vector<bool> compared(4200, true);
  for (std::size_t i = 100; i < 300; ++i) {
    commanded_N[i] *= 0.2;  // a gate that opens
    compared[i] = false;
  }
  const ForceComparison found = compare_forces({commanded_N, presses(4200), {}, compared});
  EXPECT_NEAR(found.error_rms_N, 0.0, 1e-12);
  EXPECT_NEAR(found.gain, 1.0, 1e-6);
}

TEST(ForceComparison, WithoutAForceNothingIsSaid) {
  const std::vector<Vec3> none(500, Vec3::Zero());
  const ForceComparison found = compare_forces({none, none, {}, {}});
  EXPECT_EQ(found.ticks, 0u);
  EXPECT_TRUE(std::isnan(found.gain) && std::isnan(found.lag_s) && std::isnan(found.noise_rms_N));
  EXPECT_EQ(compare_forces({}).ticks, 0u);
}

class Planted : public ::testing::TestWithParam<const char*> {};

TEST_P(Planted, IsFoundWithin10Percent) {
  const PlantedFaults faults = parse_planted_faults(GetParam());
  const std::vector<Vec3> true_N = presses(5600);
  const ForceComparison before = compare_forces({true_N, true_N, {}, {}});
  const ForceComparison after = compare_forces({plant(faults, true_N), true_N, {}, {}});
  const PlantedFaults found = found_faults(before, after);
  EXPECT_NEAR(found.delay_s, faults.delay_s, 0.5e-3);
  EXPECT_NEAR(found.scale, faults.scale, 0.01);
  EXPECT_NEAR(found.rotate_rad, faults.rotate_rad, 0.5 * kDegree_rad);
  EXPECT_NEAR(found.noise_N, faults.noise_N, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Faults, Planted,
                         ::testing::Values("delay_ms=5", "scale=0.9", "rotate_deg=5", "noise_mN=20",
                                           "delay_ms=5,scale=0.9,rotate_deg=5,noise_mN=20"));

TEST(PlantedFaults, NoneChangesNoBit) {
  const std::vector<Vec3> force_N = presses(300);
  EXPECT_EQ(plant({}, force_N), force_N);
}

TEST(PlantedFaults, WhatIsWrongIsNamed) {
  for (const char* text : {"", "delay_ms", "delay_ms=", "delay_ms=five", "delay_ms=-1", "scale=0", "scale=nan",
                           "wind=3", "delay_ms=5,,scale=1", "noise_mN=1e9"}) {
    try {
      parse_planted_faults(text);
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::Usage);
      EXPECT_NE(std::string(error.what()).find("--plant"), std::string::npos);
    }
  }
}

// Two whole periods of 40 Hz lie in the 50 ms of the mean, which is then zero.
TEST(Swing, OfASineIsItsRootMeanSquareAndOfWhatIsSlowNothing) {
  EXPECT_NEAR(swing_N(sine(0.1, 40.0, 1024)), 0.1 / std::numbers::sqrt2, 1e-3);
  EXPECT_LT(swing_N(sine(0.1, 2.0, 1024)), 2e-3);
  EXPECT_EQ(swing_N(std::vector<Vec3>(500, Vec3(1.0, 2.0, 3.0))), 0.0);
  EXPECT_EQ(swing_N(sine(0.1, 40.0, 49)), 0.0);
}

}  // namespace
}  // namespace myotact::measure
