#pragma once

#include "simulation/limb/limb.h"
#include "simulation/worker_pool.h"

namespace myotact::simulation {

/// Mass over (time constant)^2 is added to the matrix of a static Newton step: at 2 ms an element's inertia equals its
/// stiffness and the step is short; beyond 1000 s the iteration is Newton's.
inline constexpr double kShortestTime_s = 1e-4, kLongestTime_s = 1e3;
/// The time constant after a step of which this part (0 .. 1) was gone: longer after a whole step, shorter below 0.3.
double next_time_s(double time_s, double part);

/// Load of a static solve: no rates, nothing held. Gravity in the world.
TissueLoad static_load(const Vec3& gravity_m_s2);
/// Out-of-balance force over the size of the forces, of the last forces pass. Tool springs not included.
double rest_share(const LimbMuscle& muscle);

/// Static equilibrium of all muscles together, joints held, from the present state, which is carefully changed: no node
/// goes far before the faces under the nodes are found anew. True when every share is below `wanted_share` and stays
/// small on the faces that lie under the nodes then. One caller; the result does not depend on the workers.
bool settle_together(Limb& limb, double wanted_share, WorkerPool& workers);

}  // namespace myotact::simulation
