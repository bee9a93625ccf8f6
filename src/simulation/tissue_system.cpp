#include "simulation/tissue_system.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "simulation/fibre_curves.h"

namespace myotact::simulation {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

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
  TetVector gathered;
  for (std::size_t a = 0; a < kTetNodes; ++a) {
    const double* value = values.data() + 3 * element.nodes[a];
    for (std::size_t i = 0; i < 3; ++i) gathered[i * kTetNodes + a] = value[i];
  }
  return gathered;
}

/// Force-velocity factor at a point and its slope against the stretch: the curve's tangent at the last step's speed,
/// taken at the new speed, so that the damping of the fibres is implicit and one Newton step is enough.
struct SpeedFactor {
  double value = 1.0;
  double slope = 0.0;
};

SpeedFactor speed_factor(const Pass& pass, std::size_t point, double stretch) {
  if (!pass.load.force_velocity || pass.load.rule.rate_1_s == 0.0) return {};
  const double to_speed = pass.tissue.fibre_map.gain / kLargestShortening_lo_s;
  const double history = pass.load.rule.history(pass.state.last.stretch[point], pass.state.before.stretch[point]);
  const double speed = to_speed * (pass.load.rule.rate_1_s * stretch - history);
  // The tangent is taken within the range in which the curve was measured.
  const double known = std::clamp(to_speed * pass.state.stretch_rate_1_s[point], -1.0, 1.0);
  const double slope = force_velocity_slope(known);
  const double value = force_velocity(known) + slope * (speed - known);
  if (value <= 0.0) return {0.0, 0.0};  // a fibre never pushes
  return {value, slope * to_speed * pass.load.rule.rate_1_s};
}

FibreStress fibre_stress(const Pass& pass, const TissueElement& element, std::size_t first_point,
                         const TetPoints& points) {
  FibreStress fibre;
  if (element.peak_Pa == 0.0) return fibre;
  const FibreMap& map = pass.tissue.fibre_map;
  const double a = pass.state.activation, peak = map.scale * element.peak_Pa;
  for (std::size_t p = 0; p < kTetPoints; ++p) {
    const double n = map.length(points.stretch[p]);
    const SpeedFactor speed = speed_factor(pass, first_point + p, points.stretch[p]);
    const double length = active_force_length(n);
    fibre.stress_Pa[p] = peak * (a * length * speed.value + passive_force_length(n));
    fibre.slope_Pa[p] =
        peak * ((a * active_force_length_slope(n) * speed.value + passive_force_length_slope(n)) * map.gain +
                           a * length * speed.slope);
  }
  return fibre;
}

TissueMaterial material_of(const TissueElement& element, double activation) {
  if (element.sheath) return kTendonSheath;
  TissueMaterial material = kMuscleMatrix;
  material.fluctuation_Pa += kActiveFluctuation * activation * element.peak_Pa;
  return material;
}

void scatter_matrix(const TissueElement& element, const MuscleTissue& tissue, const TetMatrix& stiffness,
                    double* values) {
  std::size_t pair = 0;
  for (std::size_t a = 0; a < kTetNodes; ++a) {
    for (std::size_t b = a; b < kTetNodes; ++b, ++pair) {
      const BlockSlot slot = element.slots[pair];
      if (slot.base < 0) continue;
      const bool in_order = tissue.free_index[at(element.nodes[a])] >= tissue.free_index[at(element.nodes[b])];
      const std::size_t row = in_order ? a : b, column = in_order ? b : a;
      for (std::size_t j = 0; j < 3; ++j) {
        double* out = values + slot.base + static_cast<int>(j) * slot.stride;
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t r = i * kTetNodes + row, c = j * kTetNodes + column;
          out[i] += i <= j ? stiffness[r * kTetDofs + c] : stiffness[c * kTetDofs + r];
        }
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
    const Vec3 slope = pass.skeleton.point_derivative(body, joint, node_vector(pass.state.now.position_m, element.nodes[a]));
    for (std::size_t i = 0; i < 3; ++i) motion[i * kTetNodes + a] = slope[static_cast<Eigen::Index>(i)];
  }
  return any;
}

double dot(const TetVector& a, const TetVector& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// Columns and rows of the joints that move clamped nodes of the element.
void scatter_joints(const Pass& pass, const TissueElement& element, const TetMatrix& stiffness) {
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    TetVector motion;
    if (!joint_motion(pass, element, j, motion)) continue;
    const TetVector force = multiply(stiffness, motion);
    for (std::size_t a = 0; a < kTetNodes; ++a) {
      const int f = pass.tissue.free_index[at(element.nodes[a])];
      if (f < 0) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        pass.system.coupling_N_rad(3 * f + static_cast<int>(i), j) += force[i * kTetNodes + a];
      }
    }
    for (int k = 0; k < pass.skeleton.joint_count(); ++k) {
      TetVector other;
      if (joint_motion(pass, element, k, other)) pass.system.joint_stiffness_Nm_rad(k, j) += dot(other, force);
    }
  }
}

void add_elements(const Pass& pass) {
  TetPoints points;
  TetMatrix stiffness;
  for (std::size_t t = 0; t < pass.tissue.elements.size(); ++t) {
    const TissueElement& element = pass.tissue.elements[t];
    deform(element.rest, element.fibre, gather(element, pass.state.now.position_m), points);
    const FibreStress fibre = fibre_stress(pass, element, t * kTetPoints, points);
    const TissueMaterial material = material_of(element, pass.state.activation);
    const ElementInputs inputs{element.rest, material, points, element.fibre, fibre};
    const TetVector forces = elastic_forces(inputs);
    for (std::size_t a = 0; a < kTetNodes; ++a) {
      double* out = pass.system.internal_N.data() + 3 * element.nodes[a];
      for (std::size_t i = 0; i < 3; ++i) out[i] += forces[i * kTetNodes + a];
    }
    pass.system.force_scale_N += dot(forces, forces);
    for (std::size_t p = 0; p < kTetPoints; ++p) {
      pass.state.now.stretch[t * kTetPoints + p] = points.stretch[p];
      pass.system.smallest_J = std::min(pass.system.smallest_J, points.J[p]);
    }
    if (!pass.tangent) continue;
    elastic_stiffness(inputs, pass.load.definite, stiffness);
    scatter_matrix(element, pass.tissue, stiffness, pass.system.matrix.values());
    scatter_joints(pass, element, stiffness);
  }
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
  system.internal_N = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * tissue.body.size()));
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
