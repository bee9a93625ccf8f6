#include "simulation/particle/particle.h"

namespace myotact::simulation {

Vec3 ParticleSprings::force_N(const Vec3& position_m) const {
  return first_N_m * (first_end_m - position_m) + second_N_m * (second_end_m - position_m);
}

ParticleState step_particle(const ParticleState& state, const ParticleSprings& springs, Integration integration,
                            double h_s) {
  const double M = springs.mass_kg;
  const Vec3 f0_N = springs.force_N(state.position_m);
  if (integration == Integration::Explicit) {
    return {state.position_m + h_s * state.velocity_m_s, state.velocity_m_s + h_s / M * f0_N};
  }
  const double K_N_m = -(springs.first_N_m + springs.second_N_m);
  const Vec3 v1_m_s = (M * state.velocity_m_s + h_s * f0_N) / (M - h_s * h_s * K_N_m);
  return {state.position_m + h_s * v1_m_s, v1_m_s};
}

}  // namespace myotact::simulation
