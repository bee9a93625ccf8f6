#pragma once

#include "simulation/limb/limb.h"
#include "simulation/worker_pool.h"

namespace myotact::simulation {

/// Static equilibrium of all muscles at the given joint angles and the activations set in their states: everything at
/// rest, fibres at isometric force. Starts from the present state, carried along with the bones, in parts of 5 degrees
/// at most. Ends the step's springs. `angles_rad`: one a joint, finite. False when a muscle did not come to rest; the
/// state is then its best one.
bool settle_limb(Limb& limb, std::span<const double> angles_rad, WorkerPool& workers);
/// The same at these activations, one a muscle; starts from those set in the states and leaves these there.
bool settle_limb(Limb& limb, std::span<const double> angles_rad, std::span<const double> activations,
                 WorkerPool& workers);

/// Static equilibrium of one muscle in the skeleton's pose, from its present state, until the out-of-balance force is
/// below `wanted_share` of the size of the forces. False when it does not get there.
/// Only the free nodes move; neighbours stay where they were seen last. For one task at a time.
bool settle_muscle(const Skeleton& skeleton, const Vec3& gravity_m_s2, double wanted_share, LimbMuscle& muscle);

/// Refreshes the quasi-static stiffness of one muscle about every joint: -d(torque)/d(angle) at held activation with
/// the tissue following in equilibrium (Schur complement of the static tangent, no inertia, no force-velocity). Its
/// neighbours follow as in their own last refresh: exact once each was refreshed a few times. Keeps the old value
/// when the tangent is singular. Of a Line muscle: its line at rest. Different muscles one after the other, since each
/// reads its neighbours; beside it others may only read.
void refresh_muscle_stiffness(const Limb& limb, LimbMuscle& muscle);

/// The same of all muscles, exact at once, and what contact adds to it: the stiffness less the one that is left when
/// all contact forces are held as they are while the joint rotates. Twice the cost.
void refresh_stiffness(Limb& limb, WorkerPool& workers);

}  // namespace myotact::simulation
