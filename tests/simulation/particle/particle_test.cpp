#include "simulation/particle/particle.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include "simulation/particle/tether.h"

namespace myotact::simulation {
namespace {

/// w^2 = (30 + 50) / 0.2 = 400.
const ParticleSprings kSprings{0.2, 30.0, 50.0, {0.04, 0.0, -0.02}, {-0.01, 0.03, 0.0}};
constexpr double kOmega_rad_s = 20.0;
const ParticleState kStart{{0.01, -0.02, 0.005}, {0.1, 0.0, -0.3}};

Vec3 rest_m() {
  return (30.0 * kSprings.first_end_m + 50.0 * kSprings.second_end_m) / 80.0;
}

ParticleState after(int steps, Integration integration, double h_s) {
  ParticleState state = kStart;
  for (int i = 0; i < steps; ++i) state = step_particle(state, kSprings, integration, h_s);
  return state;
}

/// x = a cos(w t) + b sin(w t) round the place of rest: what both rules approach as h goes to 0, to first order.
TEST(Particle, BothRulesApproachTheClosedFormToFirstOrder) {
  constexpr double kTime_s = 0.3;
  const Vec3 exact_m = rest_m() + std::cos(kOmega_rad_s * kTime_s) * (kStart.position_m - rest_m()) +
                       std::sin(kOmega_rad_s * kTime_s) / kOmega_rad_s * kStart.velocity_m_s;
  for (const Integration integration : {Integration::Implicit, Integration::Explicit}) {
    const double coarse_m = (after(3000, integration, 1e-4).position_m - exact_m).norm();
    const double fine_m = (after(30000, integration, 1e-5).position_m - exact_m).norm();
    EXPECT_LT(fine_m, 3e-5);
    EXPECT_NEAR(coarse_m / fine_m, 10.0, 0.5);
  }
}

/// Backward Euler multiplies x + i y of a mode by 1 / (1 - i w h), forward Euler by 1 + i w h (Hairer, Norsett and
/// Wanner, Solving Ordinary Differential Equations I): each state is known in closed form at any step.
TEST(Particle, EachRuleTurnsAndScalesByItsKnownFactor) {
  constexpr double kH_s = 0.01;
  constexpr int kSteps = 60;
  const std::complex<double> i(0.0, 1.0), forwards = 1.0 - i * (kOmega_rad_s * kH_s);
  for (const Integration integration : {Integration::Implicit, Integration::Explicit}) {
    const std::complex<double> factor =
        integration == Integration::Explicit ? forwards : 1.0 / (1.0 + i * (kOmega_rad_s * kH_s));
    const std::complex<double> turned = std::pow(factor, kSteps);
    const ParticleState state = after(kSteps, integration, kH_s);
    for (int k = 0; k < 3; ++k) {
      const std::complex<double> mode0(kStart.position_m[k] - rest_m()[k], kStart.velocity_m_s[k] / kOmega_rad_s);
      const std::complex<double> mode = turned * mode0;
      EXPECT_NEAR(state.position_m[k], rest_m()[k] + mode.real(), 1e-12);
      EXPECT_NEAR(state.velocity_m_s[k], kOmega_rad_s * mode.imag(), 1e-11);
    }
  }
}

double energy_J(const ParticleState& state) {
  return 0.5 * kSprings.mass_kg * state.velocity_m_s.squaredNorm() +
         0.5 * 80.0 * (state.position_m - rest_m()).squaredNorm();
}

/// By 1 + (w h)^2 a step: that is why it was given up.
TEST(Particle, ExplicitStepsGainWhatImplicitOnesLose) {
  const double gain = std::pow(1.0 + 0.2 * 0.2, 100);
  EXPECT_NEAR(energy_J(after(100, Integration::Explicit, 0.01)) / energy_J(kStart), gain, 1e-9 * gain);
  EXPECT_NEAR(energy_J(after(100, Integration::Implicit, 0.01)) / energy_J(kStart), 1.0 / gain, 1e-9);
  EXPECT_LT(energy_J(after(100, Integration::Implicit, 1e3)), 1e-9 * energy_J(kStart));  // at any step
}

/// Where nothing pulls it flies on.
TEST(Particle, WithoutSpringsItKeepsItsVelocity) {
  const ParticleSprings none{0.2, 0.0, 0.0};
  for (const Integration integration : {Integration::Implicit, Integration::Explicit}) {
    const ParticleState state = step_particle(kStart, none, integration, 0.5);
    EXPECT_NEAR((state.velocity_m_s - kStart.velocity_m_s).norm(), 0.0, 1e-15);
    EXPECT_NEAR((state.position_m - kStart.position_m - 0.5 * kStart.velocity_m_s).norm(), 0.0, 1e-15);
  }
}

messages::ToolState hand_at(const Vec3& place_m, std::uint64_t sequence) {
  messages::ToolState state;
  state.sequence = sequence;
  state.tool_position_world_m = to_array(place_m);
  return state;
}

/// At rest every spring's force is balanced; a tool that nobody has in hand has no spring.
TEST(Tether, EveryHandHasASpringOfItsOwn) {
  anatomy::Specimen specimen;
  specimen.bodies = {{"cube", 1.0, Vec3::Zero(), {}, false}, {"particle", 1.0, {0.0, 0.0, 0.04}, {}, false}};
  TetherSettings settings{50.0, ParticleSettings{}};
  settings.particle->cube_stiffness_N_m = 20.0;
  Tether tether(settings, specimen);
  const double nan = std::nan("");
  const std::vector<messages::ToolState> tools = {hand_at({0.06, 0.0, 0.0}, 7), hand_at({0.9, 0.9, 0.9}, 0),
                                                  hand_at({0.0, 0.03, 0.0}, 1), hand_at({nan, 0.0, 0.0}, 3)};
  for (int i = 0; i < 1000; ++i) tether.step(tools, 0.01);
  const Vec3 rest_m = 50.0 * Vec3(0.06, 0.03, 0.0) / (20.0 + 2 * 50.0);
  EXPECT_NEAR((to_vec3(tether.local().anchor_world_m) - rest_m).norm(), 0.0, 1e-12);
  EXPECT_NEAR((tether.body_pose(1) * Vec3(0.0, 0.0, 0.04) - rest_m).norm(), 0.0, 1e-12);
  EXPECT_EQ(tether.springs_world_m().size(), 3u);
  tether.step({}, 0.01);
  EXPECT_EQ(tether.springs_world_m().size(), 1u);
}

}  // namespace
}  // namespace myotact::simulation
