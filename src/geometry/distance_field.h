#pragma once

#include <array>
#include <vector>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::geometry {

/// A smoothed signed distance and its slopes at one place. The gradient is not exactly a unit vector.
struct DistanceSample {
  double distance_m = 0.0;  // < 0 inside
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian_1_m = Mat3::Zero();
};

/// Signed distance to a closed surface, sampled on a lattice around it and joined by uniform cubic B-splines: twice
/// differentiable everywhere, so that forces that follow from it have a continuous tangent. The splines smooth: on a
/// surface of mean curvature H the zero level lies h^2 H / 3 inside it (17 um on a cylinder of 10 mm radius with 1 mm
/// cells), and edges sharper than a cell are rounded. Parts thinner than two cells come out too thin.
///
/// Built once; const functions may be called from several threads and allocate nothing.
class DistanceField {
 public:
  /// Cells of `spacing_m`, or larger ones where these would be too many. Throws Error BadData when a vertex is not
  /// finite. A surface without triangles is nowhere near anything.
  DistanceField(const TriangleMesh& surface, double spacing_m);

  /// False only where the distance is positive for sure: outside the lattice or farther out than its cells. Cheap.
  bool may_be_inside(const Vec3& p) const;
  /// How far p may move before may_be_inside() can be true, at least [m]; never below 0. Four cells and less are told
  /// apart. Cheap.
  double clearance_m(const Vec3& p) const;
  /// At a place where may_be_inside() is true.
  DistanceSample sample(const Vec3& p) const;

  double spacing_m() const { return spacing_m_; }
  /// A ball that holds every place where may_be_inside() can be true.
  const Vec3& centre_m() const { return centre_m_; }
  double radius_m() const { return radius_m_; }

 private:
  void fill(const TriangleMesh& surface);
  double bound_m(int i, int j, int k) const;
  /// The sample nearest to p; null outside of the box of places that may be inside.
  const float* nearest_sample(const Vec3& p) const;
  double at(int i, int j, int k) const {
    return values_m_[static_cast<std::size_t>(i + size_[0] * (j + size_[1] * k))];
  }

  Vec3 origin_m_ = Vec3::Zero();  // of sample 0 0 0
  Vec3 centre_m_ = Vec3::Zero();
  double radius_m_ = 0.0;
  double spacing_m_ = 1.0;
  std::array<int, 3> size_{};    // samples along x, y, z
  std::vector<float> values_m_;  // x fastest
};

}  // namespace myotact::geometry
