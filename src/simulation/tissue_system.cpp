#include "simulation/tissue_system.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "simulation/fibre_field.h"

namespace myotact::simulation {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// Everything that a pass over the elements needs.
struct Pass {
  const MuscleTissue& tissue;
  const Skeleton& skeleton;
  const TissueLoad& load;
  TissueState& state;
  TissueSystem& system;
  bool tangent;
};

TetVector gather(const TissueElement& element, const Eigen::VectorXd& values) {
  TetVector gathered{};
  for (std::size_t a = 0; a < kTetNodes; ++a) {
    const double* value = values.data() + 3 * element.nodes[a];
    for (std::size_t i = 0; i < 3; ++i) gathered[i * kTetStride + a] = value[i];
  }
  return gathered;
}

TissueMaterial material_of(const TissueElement& element, double activation) {
  if (element.sheath) return kTendonSheath;
  TissueMaterial material = kMuscleMatrix;
  material.fluctuation_Pa += kActiveFluctuation * activation * element.peak_Pa;
  return material;
}

/// Row-major 3x3 block of nodes a <= b.
std::array<double, 9> block_of(const TetMatrix& stiffness, std::size_t a, std::size_t b) {
  const auto entry = [&](std::size_t i, std::size_t row, std::size_t j, std::size_t column) {
    return stiffness[(i * kTetStride + row) * kTetDofs + j * kTetStride + column];
  };
  return {entry(0, a, 0, b), entry(0, a, 1, b), entry(0, a, 2, b), entry(0, b, 1, a), entry(1, a, 1, b),
          entry(1, a, 2, b), entry(0, b, 2, a), entry(1, b, 2, a), entry(2, a, 2, b)};
}

void scatter_matrix(const TissueElement& element, const TetMatrix& stiffness, double* values) {
  std::size_t pair = 0;
  for (std::size_t a = 0; a < kTetNodes; ++a) {
    for (std::size_t b = a; b < kTetNodes; ++b, ++pair) {
      const ElementSlot& slot = element.slots[pair];
      if (slot.block.base < 0) continue;
      const std::array<double, 9> block = block_of(stiffness, a, b);
      const std::size_t down = slot.in_order ? 3 : 1, across = slot.in_order ? 1 : 3;
      for (std::size_t j = 0; j < 3; ++j) {
        double* out = values + slot.block.base + static_cast<std::ptrdiff_t>(j) * slot.block.stride;
        for (std::size_t i = 0; i < 3; ++i) out[i] += block[i * down + j * across];
      }
    }
  }
}

/// Motion of the element's clamped nodes when a joint turns; false when it moves none of them.
bool joint_motion(const Pass& pass, const TissueElement& element, int joint, TetVector& motion) {
  motion.fill(0.0);
  bool any = false;
  for (std::size_t a = 0; a < kTetNodes; ++a) {
    const int body = pass.tissue.body[at(element.nodes[a])];
    if (body < 0 || !pass.skeleton.is_distal(body, joint)) continue;
    any = true;
    const Vec3 slope =
        pass.skeleton.point_derivative(body, joint, node_vector(pass.state.now.position_m, element.nodes[a]));
    for (std::size_t i = 0; i < 3; ++i) motion[i * kTetStride + a] = slope[static_cast<Eigen::Index>(i)];
  }
  return any;
}

double dot(const TetVector& a, const TetVector& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// Columns and rows of the joints that move clamped nodes of the element.
void scatter_joints(const Pass& pass, const TissueElement& element, const TetMatrix& stiffness,
                    const TetVector& mean_part) {
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    TetVector motion;
    if (!joint_motion(pass, element, j, motion)) continue;
    pass.system.mean.joint_gradient[j] += dot(mean_part, motion);
    const TetVector force = multiply(stiffness, motion);
    for (std::size_t a = 0; a < kTetNodes; ++a) {
      const int f = pass.tissue.free_index[at(element.nodes[a])];
      if (f < 0) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        pass.system.coupling_N_rad(3 * f + static_cast<int>(i), j) += force[i * kTetStride + a];
      }
    }
    for (int k = 0; k < pass.skeleton.joint_count(); ++k) {
      TetVector other;
      if (joint_motion(pass, element, k, other)) pass.system.joint_stiffness_Nm_rad(k, j) += dot(other, force);
    }
  }
}

void scatter_mean(const TissueElement& element, const MuscleTissue& tissue, const TetVector& part,
                  Eigen::VectorXd& gradient) {
  for (std::size_t a = 0; a < kTetNodes; ++a) {
    const int f = tissue.free_index[at(element.nodes[a])];
    if (f < 0) continue;
    for (std::size_t i = 0; i < 3; ++i) gradient[3 * f + static_cast<int>(i)] += part[i * kTetStride + a];
  }
}

/// Kinematics of all elements; the force of each fibre needs the mean length of all. A step starts where the last one
/// has looked at its forces: what is known of that place stays.
void deform_elements(const Pass& pass) {
  pass.system.points.resize(pass.tissue.elements.size());
  const bool moved = pass.system.points_at_m != pass.state.now.position_m;
  pass.system.points_at_m = pass.state.now.position_m;
  for (std::size_t t = 0; t < pass.tissue.elements.size(); ++t) {
    const TissueElement& element = pass.tissue.elements[t];
    TetPoints& points = pass.system.points[t];
    if (moved) deform(element.rest, element.fibre, gather(element, pass.state.now.position_m), points);
    for (std::size_t p = 0; p < kTetPoints; ++p) {
      pass.state.now.stretch[t * kTetPoints + p] = points.stretch[p];
      pass.system.smallest_J = std::min(pass.system.smallest_J, points.J[p]);
    }
  }
}

void add_elements(const Pass& pass) {
  deform_elements(pass);
  const FibreInputs fibres{pass.tissue, pass.state, pass.load, mean_fibre_length(pass.tissue, pass.state.now.stretch),
                           mean_fibre_length(pass.tissue, pass.state.last.stretch)};
  TetMatrix stiffness;
  for (std::size_t t = 0; t < pass.tissue.elements.size(); ++t) {
    const TissueElement& element = pass.tissue.elements[t];
    const FibreStress fibre = fibre_stress(fibres, t, pass.system.points[t]);
    const TissueMaterial material = material_of(element, pass.state.activation);
    const ElementInputs inputs{element.rest, material, pass.system.points[t], element.fibre, fibre};
    const TetVector forces = elastic_forces(inputs);
    for (std::size_t a = 0; a < kTetNodes; ++a) {
      double* out = pass.system.internal_N.data() + 3 * element.nodes[a];
      for (std::size_t i = 0; i < 3; ++i) out[i] += forces[i * kTetStride + a];
    }
    pass.system.force_scale_N += dot(forces, forces);
    if (!pass.tangent) continue;
    elastic_stiffness(inputs, pass.load.definite, stiffness);
    scatter_matrix(element, stiffness, pass.system.matrix.values());
    const TetVector mean_part = mean_gradient(element, pass.system.points[t]);
    scatter_mean(element, pass.tissue, mean_part, pass.system.mean.gradient);
    if (element.clamped) scatter_joints(pass, element, stiffness, mean_part);
  }
  if (!pass.tangent) return;
  MeanTerm& mean = pass.system.mean;
  const double weight = fibre_weight_Nm(pass.tissue), factor = mean_tangent_Nm(fibres);
  const double to_length = weight > 0.0 ? pass.tissue.fibre_map.gain / weight : 0.0;
  mean.gradient *= to_length;
  mean.joint_gradient *= to_length;
  mean.factor_Nm = pass.load.definite ? std::max(factor, 0.0) : factor;
  pass.system.coupling_N_rad += mean.factor_Nm * mean.gradient * mean.joint_gradient.transpose();
  pass.system.joint_stiffness_Nm_rad += mean.factor_Nm * mean.joint_gradient * mean.joint_gradient.transpose();
}

/// Tangent of a strand over (p, angles) with its negative eigenvalues cut off.
void make_definite(StrandState& strand) {
  const Eigen::Index joints = strand.torque_Nm.size();
  Eigen::MatrixXd whole(3 + joints, 3 + joints);
  whole << strand.stiffness_N_m, strand.coupling_N_rad, strand.coupling_N_rad.transpose(), strand.stiffness_Nm_rad;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> split(whole);
  whole = split.eigenvectors() * split.eigenvalues().cwiseMax(0.0).asDiagonal() * split.eigenvectors().transpose();
  strand.stiffness_N_m = whole.topLeftCorner<3, 3>();
  strand.coupling_N_rad = whole.topRightCorner(3, joints);
  strand.stiffness_Nm_rad = whole.bottomRightCorner(joints, joints);
}

void add_strand(const Pass& pass, const TendonStrand& strand) {
  Vec3 p = Vec3::Zero();
  for (std::size_t k = 0; k < strand.nodes.size(); ++k) {
    p += strand.weights[k] * node_vector(pass.state.now.position_m, strand.nodes[k]);
  }
  StrandState state = evaluate_strand(strand, pass.skeleton, p);
  for (std::size_t k = 0; k < strand.nodes.size(); ++k) {
    pass.system.internal_N.segment<3>(3 * strand.nodes[k]) += strand.weights[k] * state.pull_N;
  }
  pass.system.muscle_torque_Nm -= state.torque_Nm;
  if (strand.at_insertion) pass.system.tension_N += state.tension_N;
  if (!pass.tangent) return;
  if (pass.load.definite) make_definite(state);
  for (std::size_t k = 0; k < strand.nodes.size(); ++k) {
    const int row = pass.tissue.free_index[at(strand.nodes[k])];
    pass.system.coupling_N_rad.middleRows<3>(3 * row) += strand.weights[k] * state.coupling_N_rad;
    for (std::size_t m = 0; m < strand.nodes.size(); ++m) {
      const int column = pass.tissue.free_index[at(strand.nodes[m])];
      if (column > row) continue;
      pass.system.matrix.add(row, column, strand.weights[k] * strand.weights[m] * state.stiffness_N_m);
    }
  }
  pass.system.joint_stiffness_Nm_rad += state.stiffness_Nm_rad;
}

/// Force of one clamped node on the joints. `force_N` holds the node; `mass_rate` is its part of the tangent [N/m].
void add_clamped_node(const Pass& pass, int node, const Vec3& force_N, double mass_rate) {
  const int body = pass.tissue.body[at(node)];
  const Vec3 x = node_vector(pass.state.now.position_m, node);
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    if (!pass.skeleton.is_distal(body, j)) continue;
    const Vec3 slope = pass.skeleton.point_derivative(body, j, x);
    pass.system.joint_residual_Nm[j] += slope.dot(force_N);
    pass.system.muscle_torque_Nm[j] -= slope.dot(node_vector(pass.system.internal_N, node));
    if (!pass.tangent) continue;
    for (int k = 0; k < pass.skeleton.joint_count(); ++k) {
      if (!pass.skeleton.is_distal(body, k)) continue;
      double stiffness = mass_rate * slope.dot(pass.skeleton.point_derivative(body, k, x));
      if (!pass.load.definite) stiffness += force_N.dot(pass.skeleton.point_second_derivative(body, j, k, x));
      pass.system.joint_stiffness_Nm_rad(j, k) += stiffness;
    }
  }
}

void add_nodes(const Pass& pass) {
  const TimeRule& rule = pass.load.rule;
  const TissueState& state = pass.state;
  for (int node = 0; node < static_cast<int>(pass.tissue.body.size()); ++node) {
    const double mass = pass.tissue.mass_kg[at(node)];
    const Vec3 x = node_vector(state.now.position_m, node);
    const Vec3 velocity = rule.rate_1_s * x - rule.history(node_vector(state.last.position_m, node),
                                                           node_vector(state.before.position_m, node));
    const Vec3 acceleration = rule.rate_1_s * velocity - rule.history(node_vector(state.last.velocity_m_s, node),
                                                                      node_vector(state.before.velocity_m_s, node));
    if (rule.rate_1_s > 0.0) pass.state.now.velocity_m_s.segment<3>(3 * node) = velocity;
    const Vec3 force = node_vector(pass.system.internal_N, node) + mass * (acceleration - pass.load.gravity_m_s2);
    const double mass_rate = mass * rule.rate_1_s * rule.rate_1_s;
    const int f = pass.tissue.free_index[at(node)];
    if (f < 0) {
      add_clamped_node(pass, node, force, mass_rate);
      continue;
    }
    pass.system.residual_N.segment<3>(3 * f) = force;
    if (pass.tangent) pass.system.matrix.add_diagonal(f, mass_rate);
  }
}

void add_tension(const Pass& pass) {
  const MuscleTissue& tissue = pass.tissue;
  Vec3 hold = Vec3::Zero();  // holds the insertion's clamped nodes against the tissue
  for (int node = 0; node < static_cast<int>(tissue.body.size()); ++node) {
    if (tissue.body[at(node)] == tissue.insertion_body) hold += node_vector(pass.system.internal_N, node);
  }
  const Vec3 end = pass.skeleton.body_pose(tissue.insertion_body) * tissue.insertion_rest_m;
  const Vec3 before = pass.skeleton.body_pose(tissue.before_insertion_body) * tissue.before_insertion_rest_m;
  pass.system.tension_N += hold.dot((end - before).normalized());
}

void run(const Pass& pass) {
  TissueSystem& system = pass.system;
  system.internal_N.setZero();
  system.muscle_torque_Nm.setZero();
  system.joint_residual_Nm.setZero();
  system.tension_N = system.force_scale_N = 0.0;
  system.smallest_J = 1e300;
  if (pass.tangent) {
    system.matrix.set_zero();
    system.coupling_N_rad.setZero();
    system.joint_stiffness_Nm_rad.setZero();
    system.mean.gradient.setZero();
    system.mean.joint_gradient.setZero();
  }
  add_elements(pass);
  system.force_scale_N = std::sqrt(system.force_scale_N);
  for (const TendonStrand& strand : pass.tissue.strands) add_strand(pass, strand);
  system.joint_residual_Nm = -system.muscle_torque_Nm;  // so far: of the strands
  add_nodes(pass);
  add_tension(pass);
}

}  // namespace

TissueState make_state(const MuscleTissue& tissue) {
  TissueFrame frame;
  const auto dofs = static_cast<Eigen::Index>(3 * tissue.mesh.nodes_m.size());
  frame.position_m.resize(dofs);
  for (std::size_t node = 0; node < tissue.mesh.nodes_m.size(); ++node) {
    frame.position_m.segment<3>(static_cast<Eigen::Index>(3 * node)) = tissue.mesh.nodes_m[node];
  }
  frame.velocity_m_s = Eigen::VectorXd::Zero(dofs);
  frame.stretch.assign(tissue.elements.size() * kTetPoints, 1.0);
  return {frame, frame, frame, std::vector<double>(frame.stretch.size(), 0.0), 0.0};
}

void place_clamped(const MuscleTissue& tissue, const Skeleton& skeleton, TissueState& state) {
  for (std::size_t node = 0; node < tissue.body.size(); ++node) {
    if (tissue.body[node] < 0) continue;
    state.now.position_m.segment<3>(static_cast<Eigen::Index>(3 * node)) =
        skeleton.body_pose(tissue.body[node]) * tissue.mesh.nodes_m[node];
  }
}

TissueSystem make_system(const MuscleTissue& tissue, const Skeleton& skeleton) {
  const Eigen::Index joints = skeleton.joint_count();
  TissueSystem system;
  system.matrix = tissue.pattern;
  system.residual_N = Eigen::VectorXd::Zero(3 * tissue.free_nodes);
  system.coupling_N_rad = Eigen::MatrixXd::Zero(3 * tissue.free_nodes, joints);
  system.joint_stiffness_Nm_rad = Eigen::MatrixXd::Zero(joints, joints);
  system.joint_residual_Nm = system.muscle_torque_Nm = Eigen::VectorXd::Zero(joints);
  system.mean = {Eigen::VectorXd::Zero(3 * tissue.free_nodes), Eigen::VectorXd::Zero(joints), 0.0};
  system.internal_N = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * tissue.body.size()));
  system.points_at_m = Eigen::VectorXd::Constant(system.internal_N.size(), std::nan(""));  // nowhere yet
  return system;
}

void compute_forces(const MuscleTissue& tissue, const Skeleton& skeleton, const TissueLoad& load, TissueState& state,
                    TissueSystem& system) {
  run({tissue, skeleton, load, state, system, false});
}

void compute_system(const MuscleTissue& tissue, const Skeleton& skeleton, const TissueLoad& load, TissueState& state,
                    TissueSystem& system) {
  run({tissue, skeleton, load, state, system, true});
}

}  // namespace myotact::simulation
