#pragma once

#include <span>

#include <Eigen/Core>

#include "core/vector.h"
#include "simulation/skeleton/skeleton.h"

namespace myotact::simulation {

/// What acts on the bones besides muscles.
struct SkeletonInput {
  Vec3 gravity_m_s2 = Vec3::Zero();            // W
  std::span<const double> velocities_rad_s;    // joints
  std::span<const double> external_torque_Nm;  // joints, positive flexes
};

/// Stop at the end of a joint's range: a one-sided spring and damper. 500 N m/rad yields 1.7 degrees under 12 N m (600
/// N at 20 mm, a strong canine triceps); softer, and the elbow visibly passes its range. Chosen, not measured: bone on
/// bone is far stiffer, which an implicit step would withstand but a hand could not distinguish.
inline constexpr double kRangeStiffness_Nm_rad = 500.0;
/// Over this angle past the end the stop's stiffness and damping rise from nothing, so that neither torque nor
/// stiffness jumps when a limb swings into it: half a degree, below what anybody sees [rad].
inline constexpr double kRangeToe_rad = 0.009;
/// Near critical for a canine forearm (0.003 kg m^2): 2 sqrt(500 * 0.003), so that the limb does not bounce off the
/// stop.
inline constexpr double kRangeDamping_Nms_rad = 2.5;

/// What an implicit step of the angles needs: mass(q) qddot = force(q, qdot). One row a joint; welds and locked joints
/// have their entries as if free (identity mass for a weld), and the caller leaves those rows out (Skeleton::moves).
struct SkeletonLoads {
  Eigen::MatrixXd mass_kg_m2;        // of the bones, in the pose set last
  Eigen::VectorXd force_Nm;          // gravity, passive joint, range stop, external torque, centrifugal terms
  Eigen::MatrixXd stiffness_Nm_rad;  // -d force / dq without the centrifugal terms
  Eigen::VectorXd damping_Nms_rad;   // -d force / d qdot, diagonal, likewise
  Eigen::VectorXd passive_Nm_rad;    // the part of the diagonal stiffness that is the joint's own (spring and stop)

  /// Fills all in the pose set last. Allocates on the first call only.
  void compute(const Skeleton& skeleton, const SkeletonInput& input);
};

}  // namespace myotact::simulation
