#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "core/vector.h"

namespace myotact::prepare {

/// Answers whether something lies near one of many places.
class NearPlaces {
 public:
  NearPlaces(const std::vector<Vec3>& places_m, double reach_m) : reach_m_(reach_m) {
    for (const Vec3& place_m : places_m) cells_[cell_of(place_m)].push_back(place_m);
  }

  /// Within the reach of a place.
  bool contain(const Vec3& p) const {
    if (cells_.empty()) return false;
    const Cell middle = cell_of(p);
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const auto found = cells_.find({middle[0] + x, middle[1] + y, middle[2] + z});
          if (found == cells_.end()) continue;
          if (std::any_of(found->second.begin(), found->second.end(),
                          [&](const Vec3& place_m) { return (p - place_m).squaredNorm() < reach_m_ * reach_m_; })) {
            return true;
          }
        }
      }
    }
    return false;
  }

 private:
  using Cell = std::array<int, 3>;
  Cell cell_of(const Vec3& p) const {
    const auto index = [&](Eigen::Index k) { return static_cast<int>(std::floor(p[k] / reach_m_)); };
    return {index(0), index(1), index(2)};
  }

  double reach_m_;
  std::map<Cell, std::vector<Vec3>> cells_;  // as wide as the reach
};

}  // namespace myotact::prepare
