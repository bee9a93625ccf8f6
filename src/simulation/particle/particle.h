#pragma once

#include "core/vector.h"

namespace myotact::simulation {

/// How step_particle() steps. Explicit gains energy in every step of an oscillation; it is here to show why it
/// should not be used.
enum class Integration { Implicit, Explicit };

/// A particle at x (world) on two springs without rest length, to x1 and to x2. A stiffness of 0 is no spring.
struct ParticleSprings {
  double mass_kg = 0.0;                                          // M, > 0
  double first_N_m = 0.0, second_N_m = 0.0;                      // k1, k2
  Vec3 first_end_m = Vec3::Zero(), second_end_m = Vec3::Zero();  // x1, x2

  /// f = k1 (x1 - x) + k2 (x2 - x)
  Vec3 force_N(const Vec3& position_m) const;
};

/// World frame.
struct ParticleState {
  Vec3 position_m = Vec3::Zero();
  Vec3 velocity_m_s = Vec3::Zero();
};

/// The state a step of h later, with the springs' ends held. With f0 the force at its start and K = -(k1 + k2) I:
///
///   implicit   v1 = (M - h^2 K)^-1 (M v0 + h f0)    x += h v1    amplitude by 1/sqrt(1 + (w h)^2) a step
///   explicit   v1 = v0 + h f0 / M                   x += h v0    amplitude by   sqrt(1 + (w h)^2) a step
///
/// where w^2 = (k1 + k2)/M. Real-time safe.
ParticleState step_particle(const ParticleState& state, const ParticleSprings& springs, Integration integration,
                            double h_s);

}  // namespace myotact::simulation
