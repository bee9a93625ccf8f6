#include "simulation/touch/local_grip.h"

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace myotact::simulation {
namespace {

/// Directions in which the point is less mobile than this part of its most mobile one count as barred.
constexpr double kBarred = 1e-6;

Mat3 pseudo_inverse(const Mat3& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(symmetric);
  Mat3 inverse = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    const double value = solver.eigenvalues()[i];
    if (!(value > kBarred * solver.eigenvalues()[2])) continue;
    inverse += solver.eigenvectors().col(i) * solver.eigenvectors().col(i).transpose() / value;
  }
  return inverse;
}

std::array<double, 9> rows_of(const Mat3& matrix) {
  std::array<double, 9> rows;
  for (int k = 0; k < 9; ++k) rows[static_cast<std::size_t>(k)] = matrix(k / 3, k % 3);
  return rows;
}

/// The part of a matrix or vector over all joints that belongs to the given ones.
Eigen::MatrixXd part(const Eigen::MatrixXd& all, const std::vector<int>& joints) {
  const auto n = static_cast<Eigen::Index>(joints.size());
  Eigen::MatrixXd some(n, n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      some(a, b) = all(joints[static_cast<std::size_t>(a)], joints[static_cast<std::size_t>(b)]);
    }
  return some;
}

/// -d(torque)/d(angle) and -d(torque)/d(angle rate) of everything on the joints.
struct JointTangent {
  Eigen::MatrixXd stiffness_Nm_rad, damping_Nms_rad;
};

JointTangent tangent_of(const Limb& limb, const GripStep& step) {
  JointTangent tangent{limb.loads.stiffness_Nm_rad, step.damping_Nms_rad};
  for (const LimbMuscle& muscle : limb.muscles) tangent.stiffness_Nm_rad.diagonal() += muscle.stiffness_Nm_rad;
  tangent.damping_Nms_rad.diagonal() += limb.loads.damping_Nms_rad;
  for (const ToolSpring& spring : limb.springs) {
    if (spring.tool == step.tool || spring.body < 0) continue;
    Eigen::Matrix3Xd slope(3, static_cast<Eigen::Index>(limb.skeleton.joint_count()));
    for (int j = 0; j < limb.skeleton.joint_count(); ++j) slope.col(j) = spring_slope(limb, spring, j);
    tangent.stiffness_Nm_rad += spring.stiffness_N_m * slope.transpose() * slope;
  }
  return tangent;
}

/// Force of the hand's own spring among all tools' in the last step.
Vec3 spring_force_N(const Limb& limb, const GripHand& hand) {
  const messages::ToolState& tool = hand.tool;
  for (std::size_t s = 0; s < limb.springs.size() && s < limb.spring_force_N.size(); ++s) {
    const ToolSpring& spring = limb.springs[s];
    if (spring.tool == hand.index && spring.muscle < 0 && spring.body == tool.grabbed_body &&
        spring.body_rest_m == to_vec3(tool.body_point_rest_m) &&
        spring.target_W_m == to_vec3(tool.body_target_world_m)) {
      return limb.spring_force_N[s];
    }
  }
  return Vec3::Zero();
}

}  // namespace

messages::LocalGrip local_grip(const Limb& limb, const anatomy::Specimen& specimen, const LocalPatch& patch,
                               const GripHand& hand) {
  const messages::ToolState& tool = hand.tool;
  messages::LocalGrip grip;
  const bool in_hand = tool.grabbed_body >= 0 && tool.grabbed_body < static_cast<int>(specimen.bodies.size()) &&
                       to_vec3(tool.body_point_rest_m).allFinite();
  if (in_hand) {
    grip.body = tool.grabbed_body;
    grip.point_rest_m = tool.body_point_rest_m;
    grip.force_world_N = to_array(spring_force_N(limb, hand));
    return grip;
  }
  const int muscles = static_cast<int>(specimen.muscles.size());  // bones are numbered after them
  const LocalPatch::Place place = patch.nearest(to_vec3(tool.tool_position_world_m), muscles, kBoneReach_m);
  if (place.surface < 0) return grip;
  grip.body = specimen.bones[static_cast<std::size_t>(place.surface - muscles)].body;
  grip.point_rest_m = to_array(limb.skeleton.body_pose(grip.body).inverse() * place.position_m);
  return grip;
}

void write_grip_motion(const Limb& limb, const GripStep& step, messages::LocalGrip& grip) {
  const Vec3 position_m = limb.skeleton.body_pose(grip.body) * to_vec3(grip.point_rest_m);
  grip.position_world_m = to_array(position_m);
  std::vector<int> joints;
  for (int j = 0; j < limb.skeleton.joint_count(); ++j) {
    if (limb.skeleton.moves(j)) joints.push_back(j);
  }
  Eigen::Matrix3Xd slope(3, static_cast<Eigen::Index>(joints.size()));
  Vec3 velocity_m_s = Vec3::Zero(), acceleration_m_s2 = Vec3::Zero();
  for (Eigen::Index a = 0; a < slope.cols(); ++a) {
    const int j = joints[static_cast<std::size_t>(a)];
    slope.col(a) = limb.skeleton.point_derivative(grip.body, j, position_m);
    velocity_m_s += slope.col(a) * limb.now.velocity_rad_s[j];
    const double change_rad_s = 1.5 * limb.now.velocity_rad_s[j] - 2.0 * limb.last.velocity_rad_s[j] +
                                0.5 * limb.before.velocity_rad_s[j];  // as the second-order step has it
    acceleration_m_s2 += slope.col(a) * (change_rad_s / step.dt_s);
  }
  grip.velocity_world_m_s = to_array(velocity_m_s);
  grip.acceleration_world_m_s2 = to_array(acceleration_m_s2);
  grip.mobility_1_kg = grip.stiffness_1_s2 = grip.damping_1_s = {};
  if (joints.empty() || slope.isZero()) return;

  const Eigen::LDLT<Eigen::MatrixXd> mass(part(limb.loads.mass_kg_m2, joints));
  const Eigen::MatrixXd rotation_by_force =
      mass.solve(slope.transpose());  // angles' acceleration by a unit force on the point
  const Mat3 mobility = slope * rotation_by_force;
  const Eigen::MatrixXd rotation_by_displacement = rotation_by_force * pseudo_inverse(mobility);
  const JointTangent tangent = tangent_of(limb, step);
  grip.mobility_1_kg = rows_of(mobility);
  grip.stiffness_1_s2 =
      rows_of(rotation_by_force.transpose() * part(tangent.stiffness_Nm_rad, joints) * rotation_by_displacement);
  grip.damping_1_s =
      rows_of(rotation_by_force.transpose() * part(tangent.damping_Nms_rad, joints) * rotation_by_displacement);
}

}  // namespace myotact::simulation
