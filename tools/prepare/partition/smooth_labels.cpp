#include "prepare/partition/smooth_labels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/LU>

#include "core/at.h"
#include "prepare/parallel.h"
#include "prepare/part/node_steps.h"
#include "prepare/partition/blurred_label.h"

namespace myotact::prepare {

namespace {

/// Free layers around all parts: two that must be (border_points.h), and as many as blurred borders may move.
constexpr int kRim = 4;
/// Rounds in which thin parts gain weight, and how much at most; parts this near to their volume are left alone.
constexpr int kRounds = 4;
constexpr double kMostWeight = 2.5, kNearEnough = 0.995;
/// A part is broken when loose pieces hold more than this part of the largest; points that it gets back have half a
/// step to their border, as whole voxels have.
constexpr double kBroken = 0.001, kMendedMargin = 0.5;
/// Parts whose weights are worked out at the same time; what they hold meanwhile is bounded by this.
constexpr std::size_t kAtOnce = 4;

/// The lattice of equal steps around all voxels of the segments.
Lattice lattice_for(const LabelVolume& volume, const IndexBox& box, double most_points) {
  const Mat3& steps_m = volume.lattice.steps_m;
  const Vec3 lengths_m(steps_m.col(0).norm(), steps_m.col(1).norm(), steps_m.col(2).norm());
  const Vec3 extent_m = box.extent().cwiseProduct(lengths_m);
  const double step_m = std::max(lengths_m.minCoeff(), std::cbrt(extent_m.prod() / most_points));
  Lattice lattice;
  for (int k = 0; k < 3; ++k) {
    lattice.counts[at(k)] = static_cast<int>(std::ceil(extent_m[k] / step_m)) + 1 + 2 * kRim;
    lattice.steps_m.col(k) = step_m * steps_m.col(k).normalized();
  }
  const Vec3 first_m = volume.lattice.origin_m + steps_m * box.low_corner();
  lattice.origin_m = first_m - lattice.steps_m * Vec3::Constant(kRim);
  return lattice;
}

/// The best and second best of all that was offered to each point.
struct Contest {
  std::vector<float> best, second, sum;
  Labels labels, runners_up;

  explicit Contest(std::size_t points)
      : best(points, 0.0F), second(points, 0.0F), sum(points, 0.0F), labels(points, 0), runners_up(points, 0) {}

  void offer(std::size_t point, float value, float weight, std::uint16_t label) {
    sum[point] += value;
    const float score = weight * value;
    if (score > best[point]) {
      second[point] = best[point];
      runners_up[point] = labels[point];
      best[point] = score;
      labels[point] = label;
    } else if (score > second[point]) {
      second[point] = score;
      runners_up[point] = label;
    }
  }

  /// What is no part has what the parts leave of one.
  void close() {
    for (std::size_t point = 0; point < best.size(); ++point) {
      const float nothing = std::max(0.0F, 1.0F - sum[point]);
      if (nothing > best[point] || labels[point] == 0) {
        second[point] = best[point];
        runners_up[point] = labels[point];
        best[point] = nothing;
        labels[point] = 0;
      } else if (nothing > second[point]) {
        second[point] = nothing;
        runners_up[point] = 0;
      }
    }
  }
};

class Smoother {
 public:
  Smoother(const LabelVolume& volume, const std::vector<ChosenSegment>& segments, int threads)
      : volume_(volume),
        segments_(segments),
        threads_(threads),
        boxes_(boxes_of(volume, segments)),
        weights_(segments.size(), 1.0F) {}

  PartVolume run(double most_points, std::vector<SmoothedPart>& parts) {
    IndexBox all;
    for (const IndexBox& box : boxes_) all.extend(box);
    lattice_ = lattice_for(volume_, all, most_points);
    Contest contest = compete();
    for (int round = 1; round < kRounds && gain_weight(contest); ++round) contest = compete();
    PartVolume result{lattice_, {}, std::move(contest.labels), margins_of(contest)};
    for (const ChosenSegment& segment : segments_) result.keys.push_back(segment.key);
    mend_broken(result);
    parts = drop_loose_pieces(result);
    return result;
  }

 private:
  double step_m3() const { return std::pow(step_m(lattice_), 3); }
  double voxels_m3(std::size_t s) const {
    return static_cast<double>(boxes_[s].voxels) * std::abs(volume_.lattice.steps_m.determinant());
  }

  /// All parts offer their blurred voxels; a few are blurred at the same time, but offered in their order.
  Contest compete() const {
    Contest contest(lattice_.size());
    for (std::size_t first = 0; first < segments_.size(); first += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, segments_.size() - first);
      std::vector<BlurredLabel> blurred(count);
      for_each_index(count, threads_, [&](std::size_t i) {
        blurred[i] =
            blur_label(volume_, segments_[first + i].layer, segments_[first + i].label, boxes_[first + i], lattice_);
      });
      for (std::size_t i = 0; i < count; ++i) {
        const auto label = static_cast<std::uint16_t>(first + i + 1);
        blurred[i].for_each(lattice_, [&](std::size_t point, float value) {
          if (value > 0.0F) contest.offer(point, value, weights_[first + i], label);
        });
      }
    }
    contest.close();
    return contest;
  }

  /// How far a point is from the border with its runner-up [steps]: across a flat border between two blurred halves
  /// their difference changes by 2 / (sqrt(2 pi) sigma) a step.
  static double margin(const Contest& contest, std::size_t point) {
    const double slope = 2.0 / (std::sqrt(2.0 * std::numbers::pi) * kBlur);
    return std::min(kLargestMargin, static_cast<double>(contest.best[point] - contest.second[point]) / slope);
  }

  /// Of each label, with the parts of a point that lie on either side of a border [lattice points].
  static std::vector<double> volumes_of(const Contest& contest) {
    std::vector<double> volumes(std::size_t{1} << 16, 0.0);
    for (std::size_t point = 0; point < contest.labels.size(); ++point) {
      if (contest.labels[point] == 0 && contest.runners_up[point] == 0) continue;
      const double own = std::min(1.0, 0.5 + margin(contest, point));
      volumes[contest.labels[point]] += own;
      volumes[contest.runners_up[point]] += 1.0 - own;
    }
    return volumes;
  }

  /// False when every part has its volume, or can gain no more.
  bool gain_weight(const Contest& contest) {
    const std::vector<double> points = volumes_of(contest);
    bool gained = false;
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      const double kept = points[s + 1] * step_m3() / voxels_m3(s);
      if (kept >= kNearEnough || static_cast<double>(weights_[s]) >= kMostWeight) continue;
      const double more = static_cast<double>(weights_[s]) / std::sqrt(std::max(kept, 0.1));
      weights_[s] = static_cast<float>(std::min(kMostWeight, more));
      gained = true;
    }
    return gained;
  }

  std::vector<std::uint8_t> margins_of(const Contest& contest) const {
    std::vector<std::uint8_t> margins(contest.best.size());
    for (std::size_t point = 0; point < margins.size(); ++point) {
      margins[point] = static_cast<std::uint8_t>(std::lround(kMarginsPerStep * margin(contest, point)));
    }
    return margins;
  }

  using Pieces = std::vector<std::vector<std::size_t>>;  // points of each, the largest first

  std::vector<Pieces> pieces_by_part(const PartVolume& result) const {
    const NodeSteps steps(lattice_.counts);
    std::vector<Pieces> pieces(segments_.size());
    std::vector<bool> seen(result.labels.size(), false);
    for (std::size_t start = 0; start < seen.size(); ++start) {
      const std::uint16_t label = result.labels[start];
      if (label == 0 || seen[start]) continue;
      std::vector<std::size_t> piece(1, start);
      seen[start] = true;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        for (const std::ptrdiff_t step : steps.linked) {
          const std::size_t next = NodeSteps::go(piece[i], step);
          if (result.labels[next] != label || seen[next]) continue;
          seen[next] = true;
          piece.push_back(next);
        }
      }
      pieces[label - std::size_t{1}].push_back(std::move(piece));
    }
    for (Pieces& own : pieces) {
      std::stable_sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
    }
    return pieces;
  }

  /// Parts that blurring broke where they are thin get all points back that lie in their own voxels.
  void mend_broken(PartVolume& result) const {
    const std::vector<Pieces> pieces = pieces_by_part(result);
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      std::size_t loose = 0;
      for (std::size_t i = 1; i < pieces[s].size(); ++i) loose += pieces[s][i].size();
      if (pieces[s].empty() || static_cast<double>(loose) > kBroken * static_cast<double>(pieces[s][0].size())) {
        take_own_voxels(s, result);
      }
    }
  }

  void take_own_voxels(std::size_t s, PartVolume& result) const {
    const Mat3 to_index = volume_.lattice.steps_m.inverse();
    const auto label = static_cast<std::uint16_t>(s + 1);
    const Labels& layer = volume_.layers[at(segments_[s].layer)];
    for (std::size_t point = 0; point < result.labels.size(); ++point) {
      if (result.labels[point] == label) continue;
      const Vec3 index = to_index * (place_m(lattice_, point) - volume_.lattice.origin_m);
      std::array<int, 3> voxel{};
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        voxel[k] = static_cast<int>(std::lround(index[static_cast<Eigen::Index>(k)]));
        inside = inside && voxel[k] >= boxes_[s].low[k] && voxel[k] <= boxes_[s].high[k];
      }
      if (!inside) continue;
      if (layer[point_at(volume_.lattice.counts, voxel[0], voxel[1], voxel[2])] != segments_[s].label) continue;
      result.labels[point] = label;
      result.margins[point] = static_cast<std::uint8_t>(kMendedMargin * kMarginsPerStep);
    }
  }

  std::vector<SmoothedPart> drop_loose_pieces(PartVolume& result) const {
    const NodeSteps steps(lattice_.counts);
    std::vector<SmoothedPart> parts(segments_.size());
    std::vector<Pieces> pieces = pieces_by_part(result);
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      auto& own = pieces[s];
      parts[s].voxels_m3 = voxels_m3(s);
      parts[s].pieces = static_cast<int>(own.size());
      if (!own.empty()) parts[s].kept_m3 = static_cast<double>(own[0].size()) * step_m3();
      for (std::size_t i = 1; i < own.size(); ++i) {
        parts[s].dropped_m3 += static_cast<double>(own[i].size()) * step_m3();
        give_away(own[i], steps, result);
      }
    }
    return parts;
  }

  /// A loose piece goes to whoever it touches most.
  static void give_away(const std::vector<std::size_t>& piece, const NodeSteps& steps, PartVolume& result) {
    const std::uint16_t label = result.labels[piece.front()];
    std::map<std::uint16_t, std::size_t> touched;
    for (const std::size_t point : piece) {
      for (const std::ptrdiff_t step : steps.linked) {
        const std::uint16_t other = result.labels[NodeSteps::go(point, step)];
        if (other != label) ++touched[other];
      }
    }
    const auto most = std::max_element(touched.begin(), touched.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const std::size_t point : piece) result.labels[point] = most->first;
  }

  const LabelVolume& volume_;
  const std::vector<ChosenSegment>& segments_;
  int threads_;
  std::vector<IndexBox> boxes_;
  std::vector<float> weights_;
  Lattice lattice_;
};

}  // namespace

PartVolume smooth_labels(const LabelVolume& volume, const std::vector<ChosenSegment>& segments, double most_points,
                         int threads, std::vector<SmoothedPart>& parts) {
  return Smoother(volume, segments, threads).run(most_points, parts);
}

}  // namespace myotact::prepare
