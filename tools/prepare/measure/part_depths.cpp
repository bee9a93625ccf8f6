#include "prepare/measure/part_depths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "prepare/field/local_radius.h"
#include "prepare/field/signed_distance.h"
#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

namespace {

using Index3 = std::array<int, 3>;

class Sampler {
 public:
  Sampler(const geometry::TriangleMesh& surface, const Lattice& lattice)
      : distance_(surface), radius_(distance_), lattice_(lattice), step_m_(step_m(lattice)) {}

  std::vector<DepthSample> run() {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : distance_.surface().positions_m) {
      box.extend(lattice_.steps_m.inverse() * (p - lattice_.origin_m));
    }
    Index3 low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      low[k] = std::max(0, static_cast<int>(std::floor(box.min()[i] - kDepthBand)));
      high[k] = std::min(lattice_.counts[k], static_cast<int>(std::ceil(box.max()[i] + kDepthBand)) + 1);
    }
    halve(low, high);
    std::sort(samples_.begin(), samples_.end(), [](const auto& a, const auto& b) { return a.point < b.point; });
    return std::move(samples_);
  }

 private:
  /// All points from `low` to before `high`, block by block; those far outside are passed over.
  void halve(const Index3& low, const Index3& high) {
    Vec3 half;
    int widest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (high[k] <= low[k]) return;
      half[static_cast<Eigen::Index>(k)] = 0.5 * (high[k] - 1 - low[k]);
      if (high[k] - low[k] > high[static_cast<std::size_t>(widest)] - low[static_cast<std::size_t>(widest)]) {
        widest = static_cast<int>(k);
      }
    }
    const Vec3 middle_m = place_m(lattice_, Vec3(low[0] + half[0], low[1] + half[1], low[2] + half[2]));
    const double depth = -distance_(middle_m) / step_m_;
    if (depth + half.norm() < -kDepthBand) return;
    if (half.isZero()) {
      const std::size_t point = point_at(lattice_.counts, low[0], low[1], low[2]);
      samples_.push_back({static_cast<std::uint32_t>(point), static_cast<float>(depth),
                          static_cast<float>(radius_(middle_m) / step_m_)});
      return;
    }
    const auto w = static_cast<std::size_t>(widest);
    Index3 first_high = high, second_low = low;
    first_high[w] = second_low[w] = (low[w] + high[w]) / 2;
    halve(low, first_high);
    halve(second_low, high);
  }

  SignedDistance distance_;
  LocalRadius radius_;
  const Lattice& lattice_;
  double step_m_;
  std::vector<DepthSample> samples_;
};

}  // namespace

void thicken(std::vector<DepthSample>& samples) {
  for (DepthSample& sample : samples) {
    const float more = std::max(0.0F, kLeastRadius - sample.radius);
    sample.depth += more;
    sample.radius += more;
  }
}

std::vector<DepthSample> sample_depths(const geometry::TriangleMesh& surface, const Lattice& lattice) {
  return Sampler(surface, lattice).run();
}

}  // namespace myotact::prepare
