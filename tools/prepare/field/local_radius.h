#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "core/vector.h"
#include "prepare/field/signed_distance.h"

namespace myotact::prepare {

/// A distance that the local radius is added to, or scaled by, changes a little faster than distance does, because the
/// radius varies in space: level sets are extracted from such fields times this.
constexpr double kFlattening = 0.75;

/// A ball inside a body that touches its surface at a place and at another.
struct TouchingBall {
  Vec3 place_m;
  double radius_m = 0.0;
};

/// At some hundred places spread over the surface.
std::vector<TouchingBall> touching_balls(const SignedDistance& body);

/// How thick a body is near a place: the radius of the largest balls that fit inside there [m], smoothed over a few
/// millimetres. Measured at the triangles (the ball that touches there), spread to a lattice, interpolated between.
class LocalRadius {
 public:
  explicit LocalRadius(const SignedDistance& body);

  double operator()(const Vec3& p) const;

 private:
  std::size_t number_of(const Eigen::Array3i& node) const;

  Vec3 origin_m_;
  double spacing_m_ = 0.0;
  Eigen::Array3i counts_;
  std::vector<double> radii_m_;  // by lattice node, z fastest
};

}  // namespace myotact::prepare
