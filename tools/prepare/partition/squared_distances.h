#pragma once

#include <algorithm>

#include <Eigen/Cholesky>

#include "core/vector.h"

namespace myotact::prepare {

/// Weighted squared distances of a place from planes, as one quadratic form (Garland and Heckbert 1997).
class SquaredDistances {
 public:
  void add_plane(const Vec3& on_it_m, const Vec3& normal, double weight) {
    const double offset = -normal.dot(on_it_m);
    squares_ += weight * normal * normal.transpose();
    linear_ += weight * offset * normal;
    constant_ += weight * offset * offset;
    weight_ += weight;
  }

  void add(const SquaredDistances& other) {
    squares_ += other.squares_;
    linear_ += other.linear_;
    constant_ += other.constant_;
    weight_ += other.weight_;
  }

  /// Weighted mean of the squared distances [m2].
  double mean_at(const Vec3& p) const {
    if (weight_ <= 0.0) return 0.0;
    return std::max(0.0, p.dot(squares_ * p) + 2.0 * linear_.dot(p) + constant_) / weight_;
  }

  /// The place where the sum is least, as near to `start` as the planes leave open, and within `reach_m` of it.
  Vec3 nearest_place(const Vec3& start, double reach_m) const {
    // A little of the distance to the start itself keeps flat and straight places from sliding away.
    constexpr double kHold = 1e-3;
    const double hold = kHold * squares_.trace();
    if (hold <= 0.0) return start;
    const Mat3 held = squares_ + hold * Mat3::Identity();
    const Vec3 place_m = held.ldlt().solve(hold * start - linear_);
    return (place_m - start).squaredNorm() <= reach_m * reach_m ? place_m : start;
  }

 private:
  Mat3 squares_ = Mat3::Zero();
  Vec3 linear_ = Vec3::Zero();
  double constant_ = 0.0, weight_ = 0.0;
};

}  // namespace myotact::prepare
