#include "simulation/muscle/tissue_system.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "core/dense_matrix.h"
#include "simulation/element/muscle_batch.h"
#include "simulation/line/line_segment.h"
#include "simulation/material/fibre_family.h"
#include "simulation/muscle/bone_contact_forces.h"
#include "simulation/muscle/fibre_field.h"
#include "simulation/muscle/neighbour_contact_forces.h"
#include "simulation/muscle/spring_elements.h"

namespace myotact::simulation {
namespace {

using Pass = TissuePass;

/// Calls action(matrix) with where the sparse part of the tangent goes.
template <class Action>
void with_matrix(const Pass& pass, const Action& action) {
  if (pass.load.in_factor)
    action(pass.system.factor.matrix);
  else
    action(pass.system.matrix);
}

using Nodes = TetNodeVectors<Eight, QuadraticTet>;
using Blocks = TetBlocks<Eight, QuadraticTet>;

using ElementVectors = std::array<Vec3, kTetNodes>;

/// Motion of an element's clamped nodes when a joint rotates; false when it moves none of them.
bool joint_motion(const Pass& pass, const TissueElement& element, int joint, ElementVectors& motion) {
  motion.fill(Vec3::Zero());
  bool any = false;
  for (std::size_t a = 0; a < kTetNodes; ++a) {
    const int body = pass.tissue.body[at(element.nodes[a])];
    if (body < 0 || !pass.skeleton.is_distal(body, joint)) continue;
    any = true;
    motion[a] = pass.skeleton.point_derivative(body, joint, node_vector(pass.state.now.position_m, element.nodes[a]));
  }
  return any;
}

double dot(const ElementVectors& a, const ElementVectors& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < kTetNodes; ++k) sum += a[k].dot(b[k]);
  return sum;
}

ElementVectors vectors_of(const Nodes& nodes, std::size_t lane) {
  ElementVectors out;
  for (std::size_t a = 0; a < kTetNodes; ++a) {
    for (std::size_t i = 0; i < 3; ++i) out[a][static_cast<Eigen::Index>(i)] = nodes[a][i].lane[lane];
  }
  return out;
}

ElementVectors multiply(const Blocks& blocks, std::size_t lane, const ElementVectors& vector) {
  ElementVectors product;
  product.fill(Vec3::Zero());
  std::size_t pair = 0;
  for (std::size_t a = 0; a < kTetNodes; ++a) {
    for (std::size_t b = a; b < kTetNodes; ++b, ++pair) {
      Mat3 block;
      for (std::size_t e = 0; e < 9; ++e)
        block(static_cast<int>(e) / 3, static_cast<int>(e) % 3) = blocks[pair][e].lane[lane];
      product[a] += block * vector[b];
      if (a != b) product[b] += block.transpose() * vector[a];
    }
  }
  return product;
}

/// Columns and rows of the joints that move clamped nodes of the element.
void scatter_joints(const Pass& pass, const TissueElement& element, const Blocks& blocks, std::size_t lane,
                    const ElementVectors& mean_part) {
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    ElementVectors motion;
    if (!joint_motion(pass, element, j, motion)) continue;
    pass.system.mean.joint_gradient[j] += dot(mean_part, motion);
    const ElementVectors force = multiply(blocks, lane, motion);
    for (std::size_t a = 0; a < kTetNodes; ++a) {
      const int f = pass.tissue.free_index[at(element.nodes[a])];
      if (f >= 0) pass.system.coupling_N_rad.col(j).segment<3>(3 * f) += force[a];
    }
    for (int k = 0; k < pass.skeleton.joint_count(); ++k) {
      ElementVectors other;
      if (joint_motion(pass, element, k, other)) pass.system.joint_stiffness_Nm_rad(k, j) += dot(other, force);
    }
  }
}

/// Kinematics of all elements; the force of each fibre needs the mean length of all. A step starts where the last one
/// has looked at its forces: what is known of that place stays.
void deform_elements(const Pass& pass) {
  TissueSystem& system = pass.system;
  if (system.points_at_m != pass.state.now.position_m) {
    system.points_at_m = pass.state.now.position_m;
    for (std::size_t b = 0; b < pass.tissue.batches.size(); ++b) {
      const TetBatch<QuadraticTet>& tets = pass.tissue.batches[b].tets;
      Nodes position;
      gather(tets, pass.state.now.position_m, position);
      deform_batch<QuadraticTet>(tets.shapes, position, system.points[b]);
    }
  }
  double volume_m3 = 0.0, rest_m3 = 0.0;
  for (std::size_t b = 0; b < pass.tissue.batches.size(); ++b) {
    const TetBatch<QuadraticTet>& tets = pass.tissue.batches[b].tets;
    for (std::size_t lane = 0; lane < at(tets.count); ++lane) {
      const double tet_m3 = tets.shapes.volume_m3.lane[lane];
      rest_m3 += tet_m3;
      for (std::size_t p = 0; p < kTetPoints; ++p) {
        const Point<Eight>& point = system.points[b][p];
        volume_m3 += tet_m3 / kTetPoints * point.J.lane[lane];
        pass.state.now.stretch[at(tets.tet[lane]) * kTetPoints + p] =
            std::max(std::sqrt(point.I4.lane[lane]), kShortestStretch);
        system.smallest_J = std::min(system.smallest_J, point.J.lane[lane]);
      }
    }
  }
  system.volume_ratio = volume_m3 / rest_m3;
}

Eight fluctuation_of(const TissueBatch& batch, double activation) {
  const TissueMaterial& material = batch.sheath ? kTendonSheath : kMuscleMatrix;
  Eight fluctuation;
  for (std::size_t lane = 0; lane < kBatch; ++lane) {
    fluctuation.lane[lane] = material.fluctuation_Pa + kActiveFluctuation * activation * batch.peak_Pa.lane[lane];
  }
  return fluctuation;
}

void add_forces(const Pass& pass, const TissueBatch& batch, const MuscleBatch& muscle) {
  Nodes forces;
  muscle_forces(muscle, forces);
  scatter(batch.tets, forces, pass.system.internal_N);
  for (std::size_t lane = 0; lane < at(batch.tets.count); ++lane) {
    for (const Vector3<Eight>& node : forces) {
      for (const Eight& component : node) pass.system.force_scale_N += component.lane[lane] * component.lane[lane];
    }
  }
}

void add_stiffness(const Pass& pass, std::size_t index, const MuscleBatch& muscle) {
  const TissueBatch& batch = pass.tissue.batches[index];
  Blocks blocks;
  muscle_stiffness(muscle, pass.load.definite, blocks);
  if (pass.load.in_factor) {
    scatter<QuadraticTet>(pass.system.factor.slots[index], batch.tets.count, blocks,
                          pass.system.factor.matrix.values());
  } else {
    scatter<QuadraticTet>(batch.tets.slots, batch.tets.count, blocks, pass.system.matrix.values());
  }
  Nodes mean_parts;
  fibre_stretch_slopes(muscle.shapes, muscle.points, mean_parts);
  for (std::size_t lane = 0; lane < at(batch.tets.count); ++lane) {
    const TissueElement& element = pass.tissue.elements[at(batch.tets.tet[lane])];
    ElementVectors mean_part = vectors_of(mean_parts, lane);
    for (std::size_t a = 0; a < kTetNodes; ++a) {
      mean_part[a] *= element.peak_Pa;
      const int f = pass.tissue.free_index[at(element.nodes[a])];
      if (f >= 0) pass.system.mean.gradient.segment<3>(3 * f) += mean_part[a];
    }
    if (element.clamped) scatter_joints(pass, element, blocks, lane, mean_part);
  }
}

void write_fibre_stress(const FibreInputs& fibres, std::size_t element, std::size_t lane, MuscleBatch& muscle) {
  for (std::size_t p = 0; p < kTetPoints; ++p) {
    const FibreStress fibre = fibre_stress(fibres, element, p);
    muscle.stress_Pa[p].lane[lane] = fibre.stress_Pa;
    muscle.slope_Pa[p].lane[lane] = fibre.slope_Pa;
  }
}

void add_elements(const Pass& pass) {
  if (pass.tissue.model == TissueModel::MassSpring) {
    deform_springs(pass);
  } else {
    deform_elements(pass);
  }
  const FibreInputs fibres = fibre_inputs(pass.tissue, pass.state, pass.load);
  for (std::size_t b = 0; b < pass.tissue.batches.size(); ++b) {
    const TissueBatch& batch = pass.tissue.batches[b];
    MuscleBatch muscle{batch.tets.shapes, pass.system.points[b],
                       batch.sheath ? kTendonSheath.matrix : kMuscleMatrix.matrix,
                       fluctuation_of(batch, pass.state.activation)};
    for (std::size_t lane = 0; lane < at(batch.tets.count); ++lane) {
      write_fibre_stress(fibres, at(batch.tets.tet[lane]), lane, muscle);
    }
    add_forces(pass, batch, muscle);
    if (pass.tangent) add_stiffness(pass, b, muscle);
  }
  add_springs(pass, fibres);
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
  whole = positive_part(symmetric_eigen(whole));
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
      const Mat3 block = strand.weights[k] * strand.weights[m] * state.stiffness_N_m;
      with_matrix(pass, [&](auto& matrix) { matrix.add(row, column, block); });
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
    if (pass.tangent) with_matrix(pass, [&](auto& matrix) { matrix.add_diagonal(f, mass_rate); });
  }
}

void add_tension(const Pass& pass) {
  const MuscleTissue& tissue = pass.tissue;
  Vec3 hold = Vec3::Zero();  // holds the insertion's clamped nodes against the tissue
  for (const int node : tissue.insertion_nodes) hold += node_vector(pass.system.internal_N, node);
  const auto stop = [&](int body, const Vec3& rest_m) {
    return LineStop{body, pass.skeleton.body_pose(body) * rest_m};
  };
  const LineSegment last = measure_segment(
      pass.skeleton, stop(tissue.before_insertion_body, tissue.before_insertion_rest_m),
      stop(tissue.insertion_body, tissue.insertion_rest_m), tissue.insertion_wrap ? &*tissue.insertion_wrap : nullptr);
  pass.system.tension_N += hold.dot(last.slope_to);
}

void run(const Pass& pass) {
  TissueSystem& system = pass.system;
  system.internal_N.setZero();
  system.muscle_torque_Nm.setZero();
  system.joint_residual_Nm.setZero();
  system.tension_N = system.force_scale_N = system.contact_N = system.contact_depth_m = 0.0;
  system.smallest_J = 1e300;
  if (pass.tangent) {
    with_matrix(pass, [](auto& matrix) { matrix.set_zero(); });
    system.coupling_N_rad.setZero();
    system.joint_stiffness_Nm_rad.setZero();
    system.mean.gradient.setZero();
    system.mean.joint_gradient.setZero();
  }
  add_elements(pass);
  add_bone_contact(pass);
  add_neighbour_contact(pass);
  system.force_scale_N = std::sqrt(system.force_scale_N);
  for (const TendonStrand& strand : pass.tissue.strands) add_strand(pass, strand);
  system.joint_residual_Nm = -system.muscle_torque_Nm;  // so far: of strands and contact
  add_nodes(pass);
  add_tension(pass);
}

/// Where a batch's blocks go in the factor.
template <class Tet>
TetSlots<Tet> factor_slots(const MuscleTissue& tissue, const BlockFactor& factor, const TetBatch<Tet>& tets) {
  TetSlots<Tet> slots{};
  for (std::size_t lane = 0; lane < at(tets.count); ++lane) {
    set_slots<Tet>(factor, free_nodes(tissue, tets.nodes[lane]), lane, slots);
  }
  return slots;
}

TissueFactor make_factor(const MuscleTissue& tissue) {
  TissueFactor factor{BlockFactor(tissue.pattern), {}, {}};
  for (const TissueBatch& batch : tissue.batches)
    factor.slots.push_back(factor_slots(tissue, factor.matrix, batch.tets));
  for (const SpringBatch& batch : tissue.springs)
    factor.spring_slots.push_back(factor_slots(tissue, factor.matrix, batch.tets));
  return factor;
}

}  // namespace

TissueSystem make_system(const MuscleTissue& tissue, const Skeleton& skeleton) {
  const Eigen::Index joints = skeleton.joint_count();
  TissueSystem system;
  system.matrix = tissue.pattern;
  system.factor = make_factor(tissue);
  system.residual_N = Eigen::VectorXd::Zero(3 * tissue.free_nodes);
  system.coupling_N_rad = Eigen::MatrixXd::Zero(3 * tissue.free_nodes, joints);
  system.joint_stiffness_Nm_rad = Eigen::MatrixXd::Zero(joints, joints);
  system.joint_residual_Nm = system.muscle_torque_Nm = Eigen::VectorXd::Zero(joints);
  system.mean = {Eigen::VectorXd::Zero(3 * tissue.free_nodes), Eigen::VectorXd::Zero(joints), 0.0};
  system.internal_N = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * tissue.body.size()));
  system.points.resize(tissue.batches.size());
  system.spring_points.resize(tissue.springs.size());
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
