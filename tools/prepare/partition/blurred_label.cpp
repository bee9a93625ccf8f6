#include "prepare/partition/blurred_label.h"

#include <cmath>
#include <numbers>

#include "core/at.h"
#include "prepare/partition/smooth_labels.h"

namespace myotact::prepare {

namespace {

/// A Gaussian is cut off here [its widths], where it is a hundredth of its height; weights then sum up to one.
constexpr double kReach = 3.0;
/// Voxels wider than the lattice's steps are blurred by this part of their spacing, or slices would show.
constexpr double kSliceBlur = 0.6;

/// Which voxels along one direction weigh on which lattice index.
struct Weights {
  int low = 0, count = 0;              // lattice indices
  std::vector<int> first;              // voxel, from the box's low end
  std::vector<std::vector<float>> of;  // from the first on
};

/// What part of a Gaussian lies before `x` widths from its middle.
double part_before(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

Weights weights_along(int k, const LabelVolume& volume, const IndexBox& box, const Lattice& lattice) {
  const double voxel_m = volume.lattice.steps_m.col(k).norm(), step = step_m(lattice);
  const double width = std::max(kBlur * step, kSliceBlur * voxel_m) / voxel_m;  // of the Gaussian [voxels]
  // Voxel of lattice index 0 along this direction, counted from the box's low end.
  const Vec3 away_m = lattice.origin_m - volume.lattice.origin_m;
  const double origin = away_m.dot(volume.lattice.steps_m.col(k)) / (voxel_m * voxel_m) - box.low[at(k)];
  const double scale = step / voxel_m;
  const int voxels = box.high[at(k)] - box.low[at(k)] + 1;
  Weights weights;
  weights.low = std::max(0, static_cast<int>(std::ceil((-0.5 - kReach * width - origin) / scale)));
  const int last = std::min(lattice.counts[at(k)] - 1,
                            static_cast<int>(std::floor((voxels - 0.5 + kReach * width - origin) / scale)));
  weights.count = std::max(0, last - weights.low + 1);
  for (int i = 0; i < weights.count; ++i) {
    const double middle = origin + scale * (weights.low + i);
    const int from = std::max(0, static_cast<int>(std::floor(middle - kReach * width)));
    const int to = std::min(voxels - 1, static_cast<int>(std::ceil(middle + kReach * width)));
    weights.first.push_back(from);
    std::vector<float>& row = weights.of.emplace_back();
    for (int v = from; v <= to; ++v) {
      row.push_back(
          static_cast<float>(part_before((v + 0.5 - middle) / width) - part_before((v - 0.5 - middle) / width)));
    }
  }
  return weights;
}

/// Weighs the middle one of three directions; `inner` values lie side by side.
std::vector<float> weigh(const std::vector<float>& values, std::size_t inner, std::size_t along, std::size_t outer,
                         const Weights& weights) {
  const auto count = static_cast<std::size_t>(weights.count);
  std::vector<float> result(inner * count * outer, 0.0F);
  for (std::size_t o = 0; o < outer; ++o) {
    for (std::size_t i = 0; i < count; ++i) {
      float* to = result.data() + (o * count + i) * inner;
      for (std::size_t w = 0; w < weights.of[i].size(); ++w) {
        const float weight = weights.of[i][w];
        const float* from = values.data() + (o * along + static_cast<std::size_t>(weights.first[i]) + w) * inner;
        for (std::size_t j = 0; j < inner; ++j) to[j] += weight * from[j];
      }
    }
  }
  return result;
}

/// By the voxels of one layer.
void extend_boxes(const std::array<int, 3>& counts, const Labels& labels, const std::vector<int>& segment_of,
                  std::vector<IndexBox>& boxes) {
  std::size_t voxel = 0;
  for (int z = 0; z < counts[2]; ++z) {
    for (int y = 0; y < counts[1]; ++y) {
      for (int x = 0; x < counts[0]; ++x, ++voxel) {
        const int segment = segment_of[labels[voxel]];
        if (labels[voxel] != 0 && segment >= 0) boxes[at(segment)].extend({{x, y, z}, {x, y, z}, 1});
      }
    }
  }
}

}  // namespace

std::vector<IndexBox> boxes_of(const LabelVolume& volume, const std::vector<ChosenSegment>& segments) {
  std::vector<IndexBox> boxes(segments.size());
  for (std::size_t layer = 0; layer < volume.layers.size(); ++layer) {
    std::vector<int> segment_of(std::size_t{1} << 16, -1);
    for (std::size_t s = 0; s < segments.size(); ++s) {
      if (at(segments[s].layer) == layer) segment_of[at(segments[s].label)] = static_cast<int>(s);
    }
    extend_boxes(volume.lattice.counts, volume.layers[layer], segment_of, boxes);
  }
  return boxes;
}

BlurredLabel blur_label(const LabelVolume& volume, int layer, int label, const IndexBox& box, const Lattice& lattice) {
  BlurredLabel blurred;
  if (box.voxels == 0) return blurred;
  std::array<std::size_t, 3> n{};
  for (std::size_t k = 0; k < 3; ++k) n[k] = at(box.high[k] - box.low[k] + 1);
  std::vector<float> values(n[0] * n[1] * n[2], 0.0F);
  std::size_t i = 0;
  for (int z = box.low[2]; z <= box.high[2]; ++z) {
    for (int y = box.low[1]; y <= box.high[1]; ++y) {
      std::size_t voxel = point_at(volume.lattice.counts, box.low[0], y, z);
      for (int x = box.low[0]; x <= box.high[0]; ++x) {
        values[i++] = volume.layers[at(layer)][voxel++] == label ? 1.0F : 0.0F;
      }
    }
  }
  for (int k = 0; k < 3; ++k) {
    const Weights weights = weights_along(k, volume, box, lattice);
    std::size_t inner = 1, outer = 1;
    for (std::size_t j = 0; j < 3; ++j) (j < at(k) ? inner : outer) *= j == at(k) ? std::size_t{1} : n[j];
    values = weigh(values, inner, n[at(k)], outer, weights);
    n[at(k)] = static_cast<std::size_t>(weights.count);
    blurred.low[at(k)] = weights.low;
    blurred.counts[at(k)] = weights.count;
  }
  blurred.values = std::move(values);
  return blurred;
}

}  // namespace myotact::prepare
