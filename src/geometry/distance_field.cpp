#include "geometry/distance_field.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/error.h"
#include "geometry/pseudo_normals.h"
#include "geometry/triangle_tree.h"

namespace myotact::geometry {
namespace {

/// Samples at most: 4 MB a surface. A canine long bone has half of it in cells of 1 mm.
constexpr double kMostSamples = 1e6;
/// Samples beyond the surface's box: a spline at the box's rim needs two, and the rim itself is outside.
constexpr int kPadding = 3;
/// Farther outside than this a sample holds a lower bound: no place that may be inside has it among its 64.
constexpr double kFarCells = 6.0;
/// A sample this many cells outside has no place within reach that may be inside: such a place lies at most half a
/// cell's diagonal (0.87) from a sample that is one cell out, and p as far from its own.
constexpr double kSurelyOutside = 2.75;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// Values of the four cubic B-splines that reach a place `t` (0 .. 1) in a cell, and their two slopes a cell.
struct Splines {
  std::array<double, 4> value, slope, curvature;

  explicit Splines(double t) {
    const double u = 1.0 - t;
    value = {u * u * u / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
             t * t * t / 6.0};
    slope = {-u * u / 2.0, (9.0 * t * t - 12.0 * t) / 6.0, -(9.0 * u * u - 12.0 * u) / 6.0, t * t / 2.0};
    curvature = {u, 3.0 * t - 2.0, 3.0 * u - 2.0, t};
  }
};

}  // namespace

DistanceField::DistanceField(const TriangleMesh& surface, double spacing_m) : spacing_m_(spacing_m) {
  if (surface.triangles.empty()) return;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : surface.positions_m) {
    if (!p.allFinite()) throw bad_data("surface", "vertex", "is not finite; a distance needs finite vertices");
    box.extend(p);
  }
  const double volume_m3 = (box.sizes() + Vec3::Constant(2.0 * kPadding * spacing_m)).prod();
  spacing_m_ = std::max(spacing_m, std::cbrt(volume_m3 / kMostSamples));
  origin_m_ = box.min() - Vec3::Constant(kPadding * spacing_m_);
  for (std::size_t a = 0; a < 3; ++a)
    size_[a] = static_cast<int>(std::ceil(box.sizes()[static_cast<int>(a)] / spacing_m_)) + 2 * kPadding + 1;
  centre_m_ = box.center();
  radius_m_ = 0.5 * box.sizes().norm() + 2.0 * kPadding * spacing_m_;
  fill(surface);
}

/// A neighbour is one cell away, so it bounds the distance here from below; a field's reach below zero without one.
double DistanceField::bound_m(int i, int j, int k) const {
  double bound_m = -kFarCells * spacing_m_;
  if (i > 0) bound_m = std::max(bound_m, at(i - 1, j, k) - spacing_m_);
  if (j > 0) bound_m = std::max(bound_m, at(i, j - 1, k) - spacing_m_);
  if (k > 0) bound_m = std::max(bound_m, at(i, j, k - 1) - spacing_m_);
  return bound_m;
}

void DistanceField::fill(const TriangleMesh& surface) {
  const TriangleTree tree(surface);
  const PseudoNormals normals(surface);
  const auto distance_m = [&](int i, int j, int k) {
    const Vec3 p = origin_m_ + spacing_m_ * Vec3(i, j, k);
    const double reach_m = i > 0 ? std::abs(at(i - 1, j, k)) + 1.001 * spacing_m_ : 2.0 * radius_m_;
    SurfacePlace place = tree.nearest(p, surface.positions_m, reach_m);
    if (place.triangle < 0) place = tree.nearest(p, surface.positions_m);  // the neighbour's was a bound
    const bool inside = (p - place.point.position_m).dot(normals.at(place)) < 0.0;
    return inside ? -place.distance_m : place.distance_m;
  };
  values_m_.reserve(index(size_[0]) * index(size_[1]) * index(size_[2]));
  for (int k = 0; k < size_[2]; ++k) {
    for (int j = 0; j < size_[1]; ++j) {
      for (int i = 0; i < size_[0]; ++i) {
        const double bound = bound_m(i, j, k);
        values_m_.push_back(static_cast<float>(bound > kFarCells * spacing_m_ ? bound : distance_m(i, j, k)));
      }
    }
  }
}

const float* DistanceField::nearest_sample(const Vec3& p) const {
  const Vec3 cell = (p - origin_m_) / spacing_m_;
  std::array<int, 3> nearest{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double c = cell[static_cast<int>(a)];
    if (!(c >= 1.0 && c < size_[a] - 2)) return nullptr;
    nearest[a] = static_cast<int>(std::lround(c));
  }
  return &values_m_[index(nearest[0] + size_[0] * (nearest[1] + size_[1] * nearest[2]))];
}

bool DistanceField::may_be_inside(const Vec3& p) const {
  const float* value_m = nearest_sample(p);
  return value_m && *value_m < spacing_m_;  // half a cell's diagonal and what smoothing takes
}

double DistanceField::clearance_m(const Vec3& p) const {
  if (const float* value_m = nearest_sample(p)) return std::max(0.0, *value_m - kSurelyOutside * spacing_m_);
  const Vec3 cell = (p - origin_m_) / spacing_m_, last(size_[0] - 2, size_[1] - 2, size_[2] - 2);
  return spacing_m_ * (Vec3::Ones() - cell).cwiseMax(cell - last).cwiseMax(0.0).norm();
}

DistanceSample DistanceField::sample(const Vec3& p) const {
  const Vec3 cell = (p - origin_m_) / spacing_m_;
  const int i0 = static_cast<int>(cell.x()), j0 = static_cast<int>(cell.y()), k0 = static_cast<int>(cell.z());
  const Splines x(cell.x() - i0), y(cell.y() - j0), z(cell.z() - k0);
  double f = 0.0, fx = 0.0, fy = 0.0, fz = 0.0, fxx = 0.0, fyy = 0.0, fzz = 0.0, fxy = 0.0, fxz = 0.0, fyz = 0.0;
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t b = 0; b < 4; ++b) {
      double v = 0.0, vx = 0.0, vxx = 0.0;  // along x
      for (std::size_t a = 0; a < 4; ++a) {
        const double value =
            at(i0 - 1 + static_cast<int>(a), j0 - 1 + static_cast<int>(b), k0 - 1 + static_cast<int>(c));
        v += x.value[a] * value;
        vx += x.slope[a] * value;
        vxx += x.curvature[a] * value;
      }
      f += y.value[b] * z.value[c] * v;
      fx += y.value[b] * z.value[c] * vx;
      fy += y.slope[b] * z.value[c] * v;
      fz += y.value[b] * z.slope[c] * v;
      fxx += y.value[b] * z.value[c] * vxx;
      fyy += y.curvature[b] * z.value[c] * v;
      fzz += y.value[b] * z.curvature[c] * v;
      fxy += y.slope[b] * z.value[c] * vx;
      fxz += y.value[b] * z.slope[c] * vx;
      fyz += y.slope[b] * z.slope[c] * v;
    }
  }
  DistanceSample out;
  out.distance_m = f;
  out.gradient = Vec3(fx, fy, fz) / spacing_m_;
  out.hessian_1_m << fxx, fxy, fxz, fxy, fyy, fyz, fxz, fyz, fzz;
  out.hessian_1_m /= spacing_m_ * spacing_m_;
  return out;
}

}  // namespace myotact::geometry
