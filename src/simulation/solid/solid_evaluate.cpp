#include <algorithm>
#include <cmath>

#include "simulation/solid/law_batch.h"
#include "simulation/solid/solid.h"

namespace myotact::simulation {
namespace {

constexpr std::size_t kNamedInverted = 8;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

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
void note_ratios(const TetBatch<Tet>& batch, const PointBatch<Tet>& points, const Eight& mean, Solid::Evaluation& out) {
  for (std::size_t lane = 0; lane < at(batch.count); ++lane) {
    double lowest = points[0].J.lane[lane];
    for (const Point<Eight>& point : points) lowest = std::min(lowest, point.J.lane[lane]);
    out.smallest_J = std::min(out.smallest_J, lowest);
    out.largest_volume_error = std::max(out.largest_volume_error, std::abs(mean.lane[lane] - 1.0));
    if (!(lowest > 0.0) && out.inverted.size() < kNamedInverted) out.inverted.push_back(batch.tet[lane]);
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
    const Eight mean = mean_ratio<Tet>(points);
    note_ratios<Tet>(batch, points, mean, out);
    respond_to<Tet>(material, points, activation, responses);
    Eight mean_factor;  // of the mean volume ratio's slope with itself [Pa / m^3]
    bool averaged = false;
    if constexpr (Tet::kPoints > 1) averaged = material.fluctuation_Pa >= 0.0;
    if constexpr (Tet::kPoints > 1) {
      if (averaged) {
        MeanVolume<Eight> volume{mean, volume_terms(material.laws, mean), {}};
        for (std::size_t lane = 0; lane < kBatch; ++lane) {
          volume.fluctuation_Pa.lane[lane] = material.fluctuation_Pa;
          mean_factor.lane[lane] = volume.term.curvature_Pa.lane[lane] - material.fluctuation_Pa;
          if (tangent == Tangent::Definite) mean_factor.lane[lane] = std::max(mean_factor.lane[lane], 0.0);
          mean_factor.lane[lane] /= batch.shapes.volume_m3.lane[lane];
        }
        add_mean_volume_batch(points, volume, responses);
      }
    }
    if (!averaged) add_own_volume<Tet>(material, points, responses);
    add_forces<Tet>(batch, responses, out);
    if (tangent == Tangent::None) continue;
    if (tangent == Tangent::Definite) make_points_definite<Tet>(responses);
    batch_stiffness<Tet>(batch.shapes, responses, blocks);
    if (averaged) {
      TetNodeVectors<Eight, Tet> slope;
      batch_volume_slopes<Tet>(batch.shapes, points, slope);
      add_outer_batch<Tet>(slope, mean_factor, blocks);
    }
    scatter(batch, blocks, out.stiffness.values());
  }
}

void Solid::evaluate_patches(const Eigen::VectorXd& position_m, double activation, Tangent tangent,
                             Evaluation& out) const {
  using Tet = LinearTet;
  std::vector<PointBatch<Tet>> points(linear_.size());
  std::vector<double> ratio(patches_.size(), 0.0);
  for (std::size_t b = 0; b < linear_.size(); ++b) {
    const TetBatch<Tet>& batch = linear_[b];
    TetNodeVectors<Eight, Tet> position;
    gather(batch, position_m, position);
    deform_batch<Tet>(batch.shapes, position, points[b]);
    note_ratios<Tet>(batch, points[b], points[b][0].J, out);
    for (std::size_t lane = 0; lane < at(batch.count); ++lane) {
      const std::size_t patch = at(patch_of_[at(batch.tet[lane])]);
      ratio[patch] += points[b][0].J.lane[lane] * batch.shapes.volume_m3.lane[lane] / patches_[patch].volume_m3;
    }
  }
  std::vector<VolumeTerm<double>> terms(patches_.size());
  std::vector<Eigen::VectorXd> slopes(patches_.size());  // of a patch's volume, 3 numbers a node of it [m^2]
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    terms[p] = volume_term_at(materials_[patches_[p].material].laws, ratio[p]);
    slopes[p] = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * patches_[p].nodes.size()));
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
    scatter(batch, blocks, out.stiffness.values());
    TetNodeVectors<Eight, Tet> slope;
    batch_volume_slopes<Tet>(batch.shapes, points[b], slope);
    for (std::size_t lane = 0; lane < at(batch.count); ++lane) {
      const std::size_t p = at(patch_of_[at(batch.tet[lane])]);
      for (std::size_t a = 0; a < Tet::kNodes; ++a) {
        const std::vector<int>& nodes = patches_[p].nodes;
        const auto place = std::lower_bound(nodes.begin(), nodes.end(), batch.nodes[lane][a]) - nodes.begin();
        for (int i = 0; i < 3; ++i) slopes[p][3 * place + i] += slope[a][at(i)].lane[lane];
      }
    }
  }
  if (tangent == Tangent::None) return;
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const Patch& patch = patches_[p];
    double factor = terms[p].curvature_Pa / patch.volume_m3;
    if (tangent == Tangent::Definite) factor = std::max(factor, 0.0);
    std::size_t pair = 0;
    for (std::size_t a = 0; a < patch.nodes.size(); ++a) {
      for (std::size_t b = a; b < patch.nodes.size(); ++b, ++pair) {
        const Mat3 block = factor * slopes[p].segment<3>(static_cast<Eigen::Index>(3 * a)) *
                           slopes[p].segment<3>(static_cast<Eigen::Index>(3 * b)).transpose();
        const PairSlot& slot = patch.slots[pair];
        for (int j = 0; j < 3; ++j) {
          double* column = out.stiffness.values() + slot.block.base + j * slot.block.stride;
          for (int i = 0; i < 3; ++i) column[i] += slot.in_order ? block(i, j) : block(j, i);
        }
      }
    }
  }
}

void Solid::evaluate(const Eigen::VectorXd& position_m, double activation, Tangent tangent, Evaluation& out) const {
  out.force_N.setZero();
  out.smallest_J = 1e300;
  out.largest_volume_error = out.force_scale_N = 0.0;
  out.inverted.clear();
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
