#include "simulation/muscle/spring_elements.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "simulation/material/fibre_family.h"

namespace myotact::simulation {
namespace {

using Nodes = TetNodeVectors<Eight, LinearTet>;
using Blocks = TetBlocks<Eight, LinearTet>;

Vec3 vector_of(const Vector3<Eight>& eight, std::size_t lane) {
  return {eight[0].lane[lane], eight[1].lane[lane], eight[2].lane[lane]};
}

Mat3 block_of(const Matrix3<Eight>& eight, std::size_t lane) {
  Mat3 block;
  for (std::size_t e = 0; e < 9; ++e) block(static_cast<int>(e) / 3, static_cast<int>(e) % 3) = eight[e].lane[lane];
  return block;
}

bool is_clamped(const TissuePass& pass, int node) {
  return pass.tissue.body[at(node)] >= 0;
}

/// Whether rotating the joint moves the node: it is clamped, and to a body beyond the joint.
bool follows(const TissuePass& pass, int node, int joint) {
  return is_clamped(pass, node) && pass.skeleton.is_distal(pass.tissue.body[at(node)], joint);
}

Vec3 motion(const TissuePass& pass, int node, int joint) {
  return pass.skeleton.point_derivative(pass.tissue.body[at(node)], joint,
                                        node_vector(pass.state.now.position_m, node));
}

/// Columns and rows of the joints that move node b; `block` is the slope of the force on a against the place of b.
void add_joint_terms(const TissuePass& pass, int a, int b, const Mat3& block) {
  const int row = pass.tissue.free_index[at(a)];
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    if (!follows(pass, b, j)) continue;
    const Vec3 force = block * motion(pass, b, j);
    if (row >= 0) pass.system.coupling_N_rad.col(j).segment<3>(3 * row) += force;
    for (int k = 0; k < pass.skeleton.joint_count(); ++k) {
      if (follows(pass, a, k)) pass.system.joint_stiffness_Nm_rad(k, j) += motion(pass, a, k).dot(force);
    }
  }
}

void add_clamped(const TissuePass& pass, const TissueElement& element, const Blocks& blocks, std::size_t lane) {
  std::size_t pair = 0;
  for (std::size_t a = 0; a < LinearTet::kNodes; ++a) {
    for (std::size_t b = a; b < LinearTet::kNodes; ++b, ++pair) {
      const int first = element.nodes[a], second = element.nodes[b];
      if (!is_clamped(pass, first) && !is_clamped(pass, second)) continue;
      const Mat3 block = block_of(blocks[pair], lane);
      if (is_clamped(pass, second)) add_joint_terms(pass, first, second, block);
      if (a != b && is_clamped(pass, first)) add_joint_terms(pass, second, first, block.transpose());
    }
  }
}

void add_mean_gradient(const TissuePass& pass, int node, const Vec3& slope) {
  MeanTerm& mean = pass.system.mean;
  const int f = pass.tissue.free_index[at(node)];
  if (f >= 0) {
    mean.gradient.segment<3>(3 * f) += slope;
    return;
  }
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    if (follows(pass, node, j)) mean.joint_gradient[j] += slope.dot(motion(pass, node, j));
  }
}

void add_forces(const TissuePass& pass, const SpringTets& tets) {
  Nodes forces;
  spring_forces(tets, forces);
  scatter(tets.batch.tets, forces, pass.system.internal_N);
  for (std::size_t lane = 0; lane < at(tets.batch.tets.count); ++lane) {
    for (const Vector3<Eight>& node : forces) pass.system.force_scale_N += vector_of(node, lane).squaredNorm();
  }
}

void add_stiffness(const TissuePass& pass, std::size_t index, const SpringTets& tets) {
  Blocks blocks;
  spring_stiffness(tets, pass.load.definite, blocks);
  const int count = tets.batch.tets.count;
  if (pass.load.in_factor) {
    scatter<LinearTet>(pass.system.factor.spring_slots[index], count, blocks, pass.system.factor.matrix.values());
  } else {
    scatter<LinearTet>(tets.batch.tets.slots, count, blocks, pass.system.matrix.values());
  }
  Nodes mean_parts;
  spring_stretch_slopes(tets, mean_parts);
  for (std::size_t lane = 0; lane < at(tets.batch.tets.count); ++lane) {
    const TissueElement& element = pass.tissue.elements[at(tets.batch.tets.tet[lane])];
    for (std::size_t a = 0; a < LinearTet::kNodes; ++a) {
      add_mean_gradient(pass, element.nodes[a], element.peak_Pa * vector_of(mean_parts[a], lane));
    }
    if (element.clamped) add_clamped(pass, element, blocks, lane);
  }
}

}  // namespace

void deform_springs(const TissuePass& pass) {
  TissueSystem& system = pass.system;
  double volume_m3 = 0.0, rest_m3 = 0.0;
  for (std::size_t b = 0; b < pass.tissue.springs.size(); ++b) {
    const TetBatch<LinearTet>& tets = pass.tissue.springs[b].tets;
    Nodes position;
    gather(tets, pass.state.now.position_m, position);
    deform_batch<LinearTet>(tets.shapes, position, system.spring_points[b]);
    const Point<Eight>& point = system.spring_points[b][0];
    for (std::size_t lane = 0; lane < at(tets.count); ++lane) {
      rest_m3 += tets.shapes.volume_m3.lane[lane];
      volume_m3 += tets.shapes.volume_m3.lane[lane] * point.J.lane[lane];
      pass.state.now.stretch[at(tets.tet[lane])] = std::max(std::sqrt(point.I4.lane[lane]), kShortestStretch);
      system.smallest_J = std::min(system.smallest_J, point.J.lane[lane]);
    }
  }
  system.volume_ratio = volume_m3 / rest_m3;
}

void add_springs(const TissuePass& pass, const FibreInputs& fibres) {
  for (std::size_t b = 0; b < pass.tissue.springs.size(); ++b) {
    const SpringBatch& batch = pass.tissue.springs[b];
    Nodes position;
    gather(batch.tets, pass.state.now.position_m, position);
    SpringTets tets{batch, position, pass.system.spring_points[b][0], {}, {}};
    for (std::size_t lane = 0; lane < at(batch.tets.count); ++lane) {
      const FibreStress fibre = fibre_stress(fibres, at(batch.tets.tet[lane]), 0);
      tets.stress_Pa.lane[lane] = fibre.stress_Pa;
      tets.slope_Pa.lane[lane] = fibre.slope_Pa;
    }
    add_forces(pass, tets);
    if (pass.tangent) add_stiffness(pass, b, tets);
  }
}

}  // namespace myotact::simulation
