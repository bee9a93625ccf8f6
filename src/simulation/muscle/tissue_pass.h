#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/pose.h"
#include "simulation/contact/neighbour_touch.h"
#include "simulation/muscle/muscle_tissue.h"
#include "simulation/skeleton/skeleton.h"
#include "simulation/time_rule.h"

// What a pass over a muscle reads and fills. tissue_system.h runs it; fibres, strands and contacts add their part.

namespace myotact::simulation {

/// One instant of a muscle, in the world. 3 numbers a node, one stretch an integration point (element by element).
struct TissueFrame {
  Eigen::VectorXd position_m;
  Eigen::VectorXd velocity_m_s;
  std::vector<double> stretch;
};

/// Which nodes may touch a bone, and where everything was when they were looked for.
struct NearBones {
  struct Node {
    int patch = -1, node = -1;  // of the muscle's bone contact; of that patch's list
  };
  std::vector<Node> nodes;     // in the order of the patches
  Eigen::VectorXd position_m;  // of all nodes; empty: not looked for yet
  std::vector<Pose> bones;     // one a patch
};

/// A muscle in motion: the iterate of the present step and the two instants before it.
struct TissueState {
  TissueFrame now, last, before;         // in the order of the second-order rule: y, y_n, y_(n-1)
  std::vector<double> stretch_rate_1_s;  // of the last step, where the force-velocity curve is linearised
  double activation = 0.0;               // 0 .. 1
  std::vector<NeighbourTouch> touches;   // of this step
  NearBones near_bones;                  // kept by add_bone_contact()
};

/// At rest in the rest position: all instants the same, stretches 1, inactive, touching nothing.
TissueState make_state(const MuscleTissue& tissue);

/// Puts every clamped node of the present iterate where its body is.
void place_clamped(const MuscleTissue& tissue, const Skeleton& skeleton, TissueState& state);

/// The vector of one node of an array of 3 numbers a node.
inline Vec3 node_vector(const Eigen::VectorXd& values, int node) {
  return values.segment<3>(3 * node);
}

/// What a solve is made of besides elasticity.
struct TissueLoad {
  TimeRule rule;                     // all zero: static, no inertia, no force-velocity
  bool force_velocity = true;        // false in static solves that use the rule as a damper only
  Vec3 gravity_m_s2 = Vec3::Zero();  // W
  bool definite = false;             // build a safe positive definite tangent
  bool contact_held = false;         // contact forces stay as they are: the tangent has none of their slopes
  bool in_factor = false;            // the sparse part of the tangent goes where it is factored, in its precision
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
  BlockFactor matrix;                             // of the free nodes: the tangent, then its factor
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
  BlockMatrix matrix;   // unless the load sets `in_factor`
  TissueFactor factor;  // of the matrix
  MeanTerm mean;
  Eigen::VectorXd residual_N;              // of the free nodes: internal forces, inertia, minus weight
  Eigen::MatrixXd coupling_N_rad;          // free dofs x joints, the mean term's part included
  Eigen::MatrixXd joint_stiffness_Nm_rad;  // joints x joints, likewise
  Eigen::VectorXd joint_residual_Nm;  // minus the torque on each joint, inertia and weight of clamped nodes included
  std::vector<PointBatch<QuadraticTet>> points;      // one a batch of elements
  Eigen::VectorXd points_at_m;                       // node positions that `points` belong to
  std::vector<PointBatch<LinearTet>> spring_points;  // of a spring net, one a batch
  // set by every pass, with or without a tangent
  Eigen::VectorXd internal_N;        // at all nodes: elastic forces, strands, contact
  Eigen::VectorXd muscle_torque_Nm;  // that the tissue exerts on the joints, positive flexes
  double tension_N = 0.0;            // on the insertion, along the line's last segment
  double force_scale_N = 0.0;        // size of the nodal forces, to compare a residual with
  double smallest_J = 1.0;           // over the integration points
  double volume_ratio = 1.0;         // of the whole muscle, now over rest
  double contact_N = 0.0;            // sum of the nodes' contact forces
  double contact_depth_m = 0.0;      // largest overlap
};

/// What a pass over a muscle reads and fills. Refers to its arguments; passes over different muscles may run at once.
struct TissuePass {
  const MuscleTissue& tissue;
  const Skeleton& skeleton;  // in the pose of the iterate
  const TissueLoad& load;
  TissueState& state;
  TissueSystem& system;
  bool tangent;  // wanted, besides the forces
};

}  // namespace myotact::simulation
