#include "simulation/line/hill_muscle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "simulation/curves/fibre_curves.h"

namespace myotact::simulation {
namespace {

/// Peak force 1000 N, optimal fibre 0.1 m, parallel fibres; the tendon of the published antagonist pairs is 0.1 m.
HillMuscle published_muscle(Tendon tendon) {
  return {1000.0, 0.1, 0.0, tendon == Tendon::Elastic ? 0.1 : 0.0, tendon};
}

/// Canine biceps brachii as estimated from dissections: strongly pennate, tendon 14 fibres long.
HillMuscle pennate_muscle(Tendon tendon) {
  return {446.6, 0.01501, 0.7156, 0.21704, tendon};
}

constexpr double kHinge_m = 0.02;  // moment arm of both muscles of the published pairs

double pair_stiffness_Nm_rad(const HillForce& force) {
  return 2.0 * kHinge_m * kHinge_m * force.stiffness_N_m;
}

/// Reach, tendon length and the two forces that must agree.
double imbalance_N(const HillMuscle& muscle, double length_m, const HillForce& force) {
  const double w = fibre_width_m(muscle);
  const double reach_m = std::sqrt(force.fibre_m * force.fibre_m - w * w);
  const double tendon_N = muscle.peak_force_N * tendon_force((length_m - reach_m) / muscle.tendon_slack_m);
  return tendon_N - force.force_N;
}

/// What the last digits of the lengths make of the imbalance; the reach is lost in l where it is short against w.
double rounding_N(const HillMuscle& muscle, double length_m, const HillForce& force) {
  const double w = fibre_width_m(muscle);
  const double reach_m = std::sqrt(force.fibre_m * force.fibre_m - w * w);
  const double lost_m = 8.0 * std::numeric_limits<double>::epsilon() *
                        (length_m + force.fibre_m * force.fibre_m / std::max(reach_m, 1e-9));
  return 1e-12 * muscle.peak_force_N +
         lost_m * std::max(force.tendon_stiffness_N_m, std::abs(force.fibre_stiffness_N_m));
}

// De Groote-Fregly muscle on an elastic tendon of 0.1 m, unit length 0.18 m.
TEST(HillMuscle, ElasticTendonMatchesThePublishedEquilibria) {
  constexpr std::array<std::array<double, 4>, 5> kExpected = {{{0.01, 0.79827, 13.031, 0.3358},
                                                               {0.1, 0.79012, 87.041, 1.0778},
                                                               {0.25, 0.78050, 208.066, 2.3933},
                                                               {0.5, 0.76971, 405.519, 4.8036},
                                                               {1.0, 0.75626, 790.108, 10.3340}}};
  const HillMuscle muscle = published_muscle(Tendon::Elastic);
  for (const auto& [activation, n, force_N, pair] : kExpected) {
    const HillForce force = hill_equilibrium(muscle, 0.18, activation);
    EXPECT_NEAR(force.fibre_m / muscle.optimal_fibre_m, n, 1e-5) << activation;
    EXPECT_NEAR(force.force_N, force_N, 1e-3) << activation;
    EXPECT_NEAR(pair_stiffness_Nm_rad(force), pair, 1e-4) << activation;
    EXPECT_NEAR(imbalance_N(muscle, 0.18, force), 0.0, 1e-9) << activation;
  }
}

TEST(HillMuscle, ShortRangeStiffnessMatchesThePublishedPair) {
  constexpr std::array<std::array<double, 2>, 5> kExpected = {
      {{0.01, 4.897}, {0.1, 17.881}, {0.25, 36.743}, {0.5, 66.368}, {1.0, 124.188}}};
  const HillMuscle muscle = published_muscle(Tendon::Elastic);
  for (const auto& [activation, pair] : kExpected) {
    // The published fibres are at their optimum length, whatever the tendon gives.
    const double force = activation + passive_force_length(1.0);
    const double tendon_stretch = 1.0 + std::log1p(force / 0.2) * 0.049 / std::log(6.0);
    const double length_m = 0.1 + 0.1 * tendon_stretch;
    const HillForce found = hill_equilibrium(muscle, length_m, activation, FibreStiffness::ShortRange);
    EXPECT_NEAR(found.fibre_m, 0.1, 1e-12) << activation;
    EXPECT_NEAR(pair_stiffness_Nm_rad(found), pair, 1e-3) << activation;
  }
}

TEST(HillMuscle, DampingMatchesThePublishedFigure) {
  const HillForce force = hill_equilibrium(published_muscle(Tendon::Rigid), 0.1, 1.0);
  EXPECT_NEAR(force.fibre_damping_Ns_m, 2451.1, 0.1);
}

TEST(HillMuscle, PennateFibresKeepTheirWidth) {
  const HillMuscle muscle = pennate_muscle(Tendon::Rigid);
  const double w = fibre_width_m(muscle);
  EXPECT_NEAR(w, 0.01501 * std::sin(0.7156), 1e-18);
  const double slack_m = tendon_slack_for_m(muscle, 0.3, 0.8);
  EXPECT_NEAR(std::hypot(0.3 - slack_m, w), 0.8 * 0.01501, 1e-15);
  EXPECT_TRUE(std::isnan(tendon_slack_for_m(muscle, 0.3, 0.5)));
  for (const double reach_m : {0.001, 0.008, 0.015}) {
    const HillForce force = hill_equilibrium(muscle, muscle.tendon_slack_m + reach_m, 0.5);
    const double l = std::hypot(reach_m, w);
    const double n = l / muscle.optimal_fibre_m;
    EXPECT_NEAR(force.fibre_m, l, 1e-15);
    EXPECT_NEAR(force.force_N, 446.6 * (0.5 * active_force_length(n) + passive_force_length(n)) * reach_m / l, 1e-9);
  }
}

TEST(HillMuscle, StiffnessIsTheSlopeOfTheForce) {
  constexpr double h_m = 1e-7;
  for (const Tendon tendon : {Tendon::Rigid, Tendon::Elastic}) {
    const HillMuscle muscle = pennate_muscle(tendon);
    for (const double activation : {0.0, 0.01, 0.3, 1.0}) {
      for (double length_m = 0.2180; length_m < 0.2400; length_m += 0.00137) {
        const double ahead_N = hill_equilibrium(muscle, length_m + h_m, activation).force_N;
        const double behind_N = hill_equilibrium(muscle, length_m - h_m, activation).force_N;
        const double slope = (ahead_N - behind_N) / (2.0 * h_m);
        const double found = hill_equilibrium(muscle, length_m, activation).stiffness_N_m;
        EXPECT_NEAR(found, slope, 1e-5 * std::abs(slope) + 1e-3) << length_m << " at " << activation;
      }
    }
  }
}

TEST(HillMuscle, SlackUnitPullsWithNothing) {
  for (const Tendon tendon : {Tendon::Rigid, Tendon::Elastic}) {
    const HillMuscle muscle = pennate_muscle(tendon);
    for (const double length_m : {-1.0, 0.0, 0.2, 0.21704}) {
      for (const double activation : {0.0, 0.01, 1.0}) {
        const HillForce force = hill_equilibrium(muscle, length_m, activation, FibreStiffness::ShortRange);
        EXPECT_EQ(force.force_N, 0.0);
        EXPECT_EQ(force.stiffness_N_m, 0.0);
        EXPECT_EQ(force.fibre_m, fibre_width_m(muscle));
      }
    }
  }
}

TEST(HillMuscle, AnyUnitAtAnyLengthIsInBalance) {
  std::mt19937 random(20261122);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  for (int i = 0; i < 20000; ++i) {
    HillMuscle muscle{between(1.0, 5000.0), between(0.003, 0.3), between(0.0, 1.3), 0.0, Tendon::Elastic};
    muscle.tendon_slack_m = muscle.optimal_fibre_m * std::exp(between(-7.0, 4.0));
    const double length_m = muscle.tendon_slack_m * between(0.9, 1.3) + muscle.optimal_fibre_m * between(0.0, 2.0);
    HillStep step{length_m, i % 3 == 0 ? 0.0 : between(0.0, 1.0), {}, 0.0, 0.0};
    step.fibre_m = step.fibre_before_m = muscle.optimal_fibre_m * between(0.3, 1.6);
    for (const TimeRule& rule : {TimeRule{}, backward_euler(0.01), second_order(0.001)}) {
      step.rule = rule;
      const HillForce force = hill_step(muscle, step);
      ASSERT_TRUE(std::isfinite(force.force_N) && std::isfinite(force.stiffness_N_m)) << i;
      ASSERT_GE(force.force_N, 0.0) << i;
      ASSERT_GE(force.fibre_m, fibre_width_m(muscle)) << i;
      if (length_m <= muscle.tendon_slack_m || std::isinf(force.fibre_stiffness_N_m)) continue;
      ASSERT_NEAR(imbalance_N(muscle, length_m, force), 0.0, rounding_N(muscle, length_m, force)) << i;
    }
  }
}

// Fibres on a rigid tendon, shortening at half their largest speed: De Groote-Fregly's published 0.23404.
TEST(HillMuscle, StepOnARigidTendonShortensWithThePublishedForce) {
  constexpr double dt_s = 1e-3, speed_m_s = 0.5 * kLargestShortening_lo_s * 0.1;
  const HillMuscle muscle = published_muscle(Tendon::Rigid);
  for (const TimeRule& rule : {backward_euler(dt_s), second_order(dt_s)}) {
    const HillStep step{0.1, 1.0, rule, 0.1 + speed_m_s * dt_s, 0.1 + 2.0 * speed_m_s * dt_s};
    EXPECT_NEAR(hill_step(muscle, step).force_N, 1000.0 * (0.23404 + passive_force_length(1.0)), 0.01);
  }
}

TEST(HillMuscle, StiffnessOfAStepIsTheSlopeOfItsForce) {
  constexpr double h_m = 1e-8;
  for (const Tendon tendon : {Tendon::Rigid, Tendon::Elastic}) {
    const HillMuscle muscle = pennate_muscle(tendon);
    for (const TimeRule& rule : {backward_euler(0.01), second_order(0.001)}) {
      for (const double moved_m : {-0.002, -0.0005, 0.0, 0.0004}) {
        HillStep step{0.2280, 0.4, rule, 0.0, 0.0};
        step.fibre_m = hill_equilibrium(muscle, step.length_m + moved_m, 0.4).fibre_m;
        step.fibre_before_m = hill_equilibrium(muscle, step.length_m + 1.5 * moved_m, 0.4).fibre_m;
        HillStep ahead = step, behind = step;
        ahead.length_m += h_m;
        behind.length_m -= h_m;
        const double slope = (hill_step(muscle, ahead).force_N - hill_step(muscle, behind).force_N) / (2.0 * h_m);
        EXPECT_NEAR(hill_step(muscle, step).stiffness_N_m, slope, 1e-5 * std::abs(slope) + 1e-2);
      }
    }
  }
}

/// Force `seconds` after a stretch of the unit by `stretch_m`, by steps of dt_s.
double relaxing_force_N(const HillMuscle& muscle, double length_m, double stretch_m, double seconds, double dt_s) {
  HillStep step{length_m + stretch_m, 0.5, {}, 0.0, 0.0};
  step.fibre_m = step.fibre_before_m = hill_equilibrium(muscle, length_m, 0.5).fibre_m;
  double force_N = 0.0;
  const int steps = static_cast<int>(std::lround(seconds / dt_s));
  for (int i = 0; i < steps; ++i) {
    step.rule = i == 0 ? backward_euler(dt_s) : second_order(dt_s);
    const HillForce force = hill_step(muscle, step);
    step.fibre_before_m = step.fibre_m;
    step.fibre_m = force.fibre_m;
    force_N = force.force_N;
  }
  return force_N;
}

// A small stretch of fibre (spring km and dashpot bm) and tendon in series relaxes as exp(-t (km + kt)/bm).
TEST(HillMuscle, StretchedUnitRelaxesAsASpringAndADashpotDo) {
  const HillMuscle muscle = pennate_muscle(Tendon::Elastic);
  const HillForce rest = hill_equilibrium(muscle, 0.228, 0.5);
  const double rate_1_s = (rest.fibre_stiffness_N_m + rest.tendon_stiffness_N_m) / rest.fibre_damping_Ns_m;
  constexpr double kStretch_m = 1e-7;
  for (const double lives : {0.5, 1.0, 2.0}) {
    const double seconds = lives / rate_1_s;
    const double found_N = relaxing_force_N(muscle, 0.228, kStretch_m, seconds, seconds / 2000.0) - rest.force_N;
    const double share = rest.tendon_stiffness_N_m / (rest.fibre_stiffness_N_m + rest.tendon_stiffness_N_m);
    const double expected_N = kStretch_m * (rest.stiffness_N_m + rest.tendon_stiffness_N_m * share * std::exp(-lives));
    EXPECT_NEAR(found_N / expected_N, 1.0, 2e-3) << lives;
  }
}

TEST(HillMuscle, StepEndsInTheEquilibriumThatItStartedAwayFrom) {
  const HillMuscle muscle = pennate_muscle(Tendon::Elastic);
  EXPECT_NEAR(relaxing_force_N(muscle, 0.225, 0.004, 10.0, 0.01), hill_equilibrium(muscle, 0.229, 0.5).force_N, 1e-9);
}

}  // namespace
}  // namespace myotact::simulation
