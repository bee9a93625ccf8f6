#pragma once

#include <vector>

#include <Eigen/Core>

#include "simulation/muscle_tissue.h"
#include "simulation/neighbour_contact.h"
#include "simulation/skeleton.h"
#include "simulation/time_rule.h"

namespace myotact::simulation {

/// One instant of a muscle. 3 numbers a node, one stretch an integration point.
struct TissueFrame {
  Eigen::VectorXd position_m;
  Eigen::VectorXd velocity_m_s;
  std::vector<double> stretch;
};

/// A muscle in motion: the iterate of the present step and the two instants before it.
struct TissueState {
  TissueFrame now, last, before;
  std::vector<double> stretch_rate_1_s;  // of the last step, where the force-velocity curve is linearised
  double activation = 0.0;
  std::vector<NeighbourTouch> touches;  // of this step
};

/// At rest in the rest position.
TissueState make_state(const MuscleTissue& tissue);

inline Vec3 node_vector(const Eigen::VectorXd& values, int node) {
  return values.segment<3>(3 * node);
}

/// Puts every clamped node of the present iterate where its body is.
void place_clamped(const MuscleTissue& tissue, const Skeleton& skeleton, TissueState& state);

/// What a solve is made of besides elasticity.
struct TissueLoad {
  TimeRule rule;               // all zero: static, no inertia, no force-velocity
  bool force_velocity = true;  // false in static solves that use the rule as a damper only
  Vec3 gravity_m_s2 = Vec3::Zero();
  bool definite = false;      // build a safe positive definite tangent
  bool contact_held = false;  // contact forces stay as they are: the tangent has none of their slopes
  bool in_factor = false;     // the sparse part of the tangent goes where it is factored, in its precision
};

/// What the mean length of the fibres adds to the tangent: factor * gradient gradient^T over free nodes and angles.
/// Dense, so the nodes' part is kept apart; coupling and joint stiffness hold theirs.
struct MeanTerm {
  Eigen::VectorXd gradient;        // of the mean normalised length against the free nodes [1/m]
  Eigen::VectorXd joint_gradient;  // against the angles [1/rad]
  double factor_Nm = 0.0;
};

/// Factor of a muscle's sparse matrix.
struct TissueFactor {
  BlockFactor matrix;
  std::vector<TetSlots<QuadraticTet>> slots;      // one a batch of elements
  std::vector<TetSlots<LinearTet>> spring_slots;  // one a batch of a spring net
};

/// One muscle's part of the arrow system
///
///   | matrix + mean  coupling        | | d nodes  |      | residual       |
///   | coupling^T     joint_stiffness | | d angles | =  - | joint_residual |
///
/// over its free nodes and all joint angles.
struct TissueSystem {
  BlockMatrix matrix;   // unless the load says `in_factor`
  TissueFactor factor;  // of the matrix
  MeanTerm mean;
  Eigen::VectorXd residual_N;
  Eigen::MatrixXd coupling_N_rad;
  Eigen::MatrixXd joint_stiffness_Nm_rad;
  Eigen::VectorXd joint_residual_Nm;
  std::vector<PointBatch<QuadraticTet>> points;      // one a batch of elements
  Eigen::VectorXd points_at_m;                       // node positions that `points` belong to
  std::vector<PointBatch<LinearTet>> spring_points;  // of a spring net, one a batch
  // of the forces pass alone
  Eigen::VectorXd internal_N;        // at all nodes: elastic forces, strands, contact
  Eigen::VectorXd muscle_torque_Nm;  // that the tissue exerts on the joints, positive flexes
  double tension_N = 0.0;            // on the insertion, along the line's last segment
  double force_scale_N = 0.0;        // size of the nodal forces, to judge a residual by
  double smallest_J = 1.0;           // over the integration points
  double volume_ratio = 1.0;         // of the whole muscle, now over rest
  double contact_N = 0.0;            // sum of the nodes' contact forces
  double contact_depth_m = 0.0;      // largest overlap
};

/// What a pass over the elements reads and fills.
struct TissuePass {
  const MuscleTissue& tissue;
  const Skeleton& skeleton;
  const TissueLoad& load;
  TissueState& state;
  TissueSystem& system;
  bool tangent;
};

TissueSystem make_system(const MuscleTissue& tissue, const Skeleton& skeleton);

/// Forces, residual and torques of the present iterate; stores its stretches in `state.now`, and its velocities unless
/// the load is static.
void compute_forces(const MuscleTissue& tissue, const Skeleton& skeleton, const TissueLoad& load, TissueState& state,
                    TissueSystem& system);
/// The same and the tangent.
void compute_system(const MuscleTissue& tissue, const Skeleton& skeleton, const TissueLoad& load, TissueState& state,
                    TissueSystem& system);

}  // namespace myotact::simulation
