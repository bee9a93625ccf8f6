#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "simulation/solid/law_batch.h"
#include "simulation/solid/solid.h"

namespace myotact::simulation {
namespace {

template <class Tet>
Eight mean_ratio(const PointBatch<Tet>& points) {
  Eight mean;
  for (std::size_t lane = 0; lane < kBatch; ++lane) {
    for (const Point<Eight>& point : points) mean.lane[lane] += point.J.lane[lane];
    mean.lane[lane] *= 1.0 / static_cast<double>(Tet::kPoints);
  }
  return mean;
}

template <class Tet>
void note_smallest_ratio(const TetBatch<Tet>& batch, const PointBatch<Tet>& points, Solid::Evaluation& out) {
  for (std::size_t lane = 0; lane < at(batch.count); ++lane) {
    for (const Point<Eight>& point : points) out.smallest_J = std::min(out.smallest_J, point.J.lane[lane]);
  }
}

template <class Tet>
void respond_to(const SolidMaterial& material, const PointBatch<Tet>& points, double activation,
                ResponseBatch<Tet>& responses) {
  responses = {};
  for (std::size_t p = 0; p < Tet::kPoints; ++p) {
    for (const Law& law : material.laws) respond(law, points[p], activation, responses[p]);
  }
}

/// Volume term of every point on its own ratio.
template <class Tet>
void add_own_volume(const SolidMaterial& material, const PointBatch<Tet>& points, ResponseBatch<Tet>& responses) {
  for (std::size_t p = 0; p < Tet::kPoints; ++p) {
    add_volume_at(points[p], volume_terms(material.laws, points[p].J), responses[p]);
  }
}

template <class Tet>
void add_forces(const TetBatch<Tet>& batch, const ResponseBatch<Tet>& responses, Solid::Evaluation& out) {
  TetNodeVectors<Eight, Tet> force;
  batch_forces<Tet>(batch.shapes, responses, force);
  scatter(batch, force, out.force_N);
  for (std::size_t lane = 0; lane < at(batch.count); ++lane) {
    for (const Vector3<Eight>& node : force) {
      for (const Eight& component : node) out.force_scale_N += component.lane[lane] * component.lane[lane];
    }
  }
}

template <class Tet>
void make_points_definite(ResponseBatch<Tet>& responses) {
  for (Response<Eight>& response : responses) make_definite(response.C);
}

MeanVolume<Eight> mean_volume(const SolidMaterial& material, const Eight& mean_J) {
  MeanVolume<Eight> volume{mean_J, volume_terms(material.laws, mean_J), {}};
  for (double& fluctuation_Pa : volume.fluctuation_Pa.lane) fluctuation_Pa = material.fluctuation_Pa;
  return volume;
}

template <class Tet>
void add_volume_of_mean(const PointBatch<Tet>& points, const MeanVolume<Eight>& volume, ResponseBatch<Tet>& responses) {
  if constexpr (Tet::kPoints > 1) add_mean_volume_batch(points, volume, responses);
}

/// The mean volume ratio's slope with itself.
template <class Tet>
void add_mean_stiffness(const TetBatch<Tet>& batch, const PointBatch<Tet>& points, const MeanVolume<Eight>& volume,
                        Solid::Tangent tangent, TetBlocks<Eight, Tet>& blocks) {
  Eight factor;
  for (std::size_t lane = 0; lane < kBatch; ++lane) {
    const double stiffness_Pa = volume.term.curvature_Pa.lane[lane] - volume.fluctuation_Pa.lane[lane];
    const bool dropped = tangent == Solid::Tangent::Definite && stiffness_Pa < 0.0;
    factor.lane[lane] = dropped ? 0.0 : stiffness_Pa / batch.shapes.volume_m3.lane[lane];
  }
  TetNodeVectors<Eight, Tet> slope;
  batch_volume_slopes<Tet>(batch.shapes, points, slope);
  add_outer_batch<Tet>(slope, factor, blocks);
}

/// matrix += factor v (x) v, for a list of nodes with the slots of its pairs.
void add_outer(const std::vector<PairSlot>& slots, const Eigen::VectorXd& v, double factor, BlockMatrix& matrix) {
  std::size_t pair = 0;
  for (Eigen::Index a = 0; a < v.size(); a += 3) {
    for (Eigen::Index b = a; b < v.size(); b += 3, ++pair) {
      const Mat3 block = factor * v.segment<3>(a) * v.segment<3>(b).transpose();
      const PairSlot& slot = slots[pair];
      for (int j = 0; j < 3; ++j) {
        double* column = matrix.values() + slot.block.base + static_cast<std::ptrdiff_t>(j) * slot.block.stride;
        for (int i = 0; i < 3; ++i) column[i] += slot.in_order ? block(i, j) : block(j, i);
      }
    }
  }
}

}  // namespace

template <class Tet>
void Solid::evaluate_batches(const std::vector<TetBatch<Tet>>& batches, const Eigen::VectorXd& position_m,
                             double activation, Tangent tangent, Evaluation& out) const {
  PointBatch<Tet> points;
  ResponseBatch<Tet> responses;
  TetBlocks<Eight, Tet> blocks;
  for (const TetBatch<Tet>& batch : batches) {
    const SolidMaterial& material = materials_[batch.material];
    TetNodeVectors<Eight, Tet> position;
    gather(batch, position_m, position);
    deform_batch<Tet>(batch.shapes, position, points);
    note_smallest_ratio<Tet>(batch, points, out);
    respond_to<Tet>(material, points, activation, responses);
    const bool averaged = Tet::kPoints > 1 && material.fluctuation_Pa >= 0.0;
    MeanVolume<Eight> volume;
    if (averaged) {
      volume = mean_volume(material, mean_ratio<Tet>(points));
      add_volume_of_mean<Tet>(points, volume, responses);
    } else {
      add_own_volume<Tet>(material, points, responses);
    }
    add_forces<Tet>(batch, responses, out);
    if (tangent == Tangent::None) continue;
    if (tangent == Tangent::Definite) make_points_definite<Tet>(responses);
    batch_stiffness<Tet>(batch.shapes, responses, blocks);
    if (averaged) add_mean_stiffness<Tet>(batch, points, volume, tangent, blocks);
    scatter<Tet>(batch.slots, batch.count, blocks, out.stiffness.values());
  }
}

/// Volume ratio of each patch, and all points.
std::vector<double> Solid::patch_ratios(const Eigen::VectorXd& position_m, std::vector<PointBatch<LinearTet>>& points,
                                        Evaluation& out) const {
  std::vector<double> ratio(patches_.size(), 0.0);
  for (std::size_t b = 0; b < linear_.size(); ++b) {
    const TetBatch<LinearTet>& batch = linear_[b];
    TetNodeVectors<Eight, LinearTet> position;
    gather(batch, position_m, position);
    deform_batch<LinearTet>(batch.shapes, position, points[b]);
    note_smallest_ratio<LinearTet>(batch, points[b], out);
    for (std::size_t lane = 0; lane < at(batch.count); ++lane) {
      const std::size_t patch = at(patch_of_[at(batch.tet[lane])]);
      ratio[patch] += points[b][0].J.lane[lane] * batch.shapes.volume_m3.lane[lane] / patches_[patch].volume_m3;
    }
  }
  return ratio;
}

/// Adds to the slopes of the patches' volumes, 3 numbers a node of the patch.
void Solid::add_volume_slopes(const TetBatch<LinearTet>& batch, const PointBatch<LinearTet>& points,
                              std::vector<Eigen::VectorXd>& slopes_m2) const {
  TetNodeVectors<Eight, LinearTet> slope;
  batch_volume_slopes<LinearTet>(batch.shapes, points, slope);
  for (std::size_t lane = 0; lane < at(batch.count); ++lane) {
    const std::size_t p = at(patch_of_[at(batch.tet[lane])]);
    const std::vector<int>& nodes = patches_[p].nodes;
    for (std::size_t a = 0; a < LinearTet::kNodes; ++a) {
      const auto place = std::lower_bound(nodes.begin(), nodes.end(), batch.nodes[lane][a]) - nodes.begin();
      for (std::size_t i = 0; i < 3; ++i) {
        slopes_m2[p][3 * place + static_cast<Eigen::Index>(i)] += slope[a][i].lane[lane];
      }
    }
  }
}

void Solid::evaluate_patches(const Eigen::VectorXd& position_m, double activation, Tangent tangent,
                             Evaluation& out) const {
  using Tet = LinearTet;
  std::vector<PointBatch<Tet>> points(linear_.size());
  const std::vector<double> ratio = patch_ratios(position_m, points, out);
  std::vector<VolumeTerm<double>> terms(patches_.size());
  std::vector<Eigen::VectorXd> slopes_m2(patches_.size());
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    terms[p] = volume_term_at(materials_[patches_[p].material].laws, ratio[p]);
    slopes_m2[p] = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * patches_[p].nodes.size()));
  }
  ResponseBatch<Tet> responses;
  TetBlocks<Eight, Tet> blocks;
  for (std::size_t b = 0; b < linear_.size(); ++b) {
    const TetBatch<Tet>& batch = linear_[b];
    respond_to<Tet>(materials_[batch.material], points[b], activation, responses);
    VolumeTerm<Eight> pressure;
    for (std::size_t lane = 0; lane < kBatch; ++lane) {
      pressure.slope_Pa.lane[lane] = terms[at(patch_of_[at(batch.tet[lane])])].slope_Pa;
    }
    add_volume_at(points[b][0], pressure, responses[0]);
    add_forces<Tet>(batch, responses, out);
    if (tangent == Tangent::None) continue;
    if (tangent == Tangent::Definite) make_points_definite<Tet>(responses);
    batch_stiffness<Tet>(batch.shapes, responses, blocks);
    scatter<LinearTet>(batch.slots, batch.count, blocks, out.stiffness.values());
    add_volume_slopes(batch, points[b], slopes_m2);
  }
  if (tangent == Tangent::None) return;
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    double factor = terms[p].curvature_Pa / patches_[p].volume_m3;
    if (tangent == Tangent::Definite) factor = std::max(factor, 0.0);
    add_outer(patches_[p].slots, slopes_m2[p], factor, out.stiffness);
  }
}

void Solid::evaluate(const Eigen::VectorXd& position_m, double activation, Tangent tangent, Evaluation& out) const {
  out.force_N.setZero();
  out.smallest_J = 1e300;
  out.force_scale_N = 0.0;
  if (tangent != Tangent::None) out.stiffness.set_zero();
  if (kind_ == ElementKind::Quadratic) {
    evaluate_batches(quadratic_, position_m, activation, tangent, out);
  } else if (kind_ == ElementKind::Linear) {
    evaluate_batches(linear_, position_m, activation, tangent, out);
  } else {
    evaluate_patches(position_m, activation, tangent, out);
  }
  out.force_scale_N = std::sqrt(out.force_scale_N);
}

}  // namespace myotact::simulation
