#include "prepare/field/local_radius.h"

#include <algorithm>
#include <cmath>

namespace myotact::prepare {

namespace {

/// Lattice nodes along the longest side of the body; the radius is smooth at that scale.
constexpr double kNodesAlong = 24.0;
/// Triangles looked at, spread evenly over their order; more change the field by less than the lattice does.
constexpr std::size_t kSamples = 600;
/// Halvings of the way to the opposite side.
constexpr int kHalvings = 12;
/// A point is the centre of a ball that touches the surface when its depth is the way from there, but for this part.
constexpr double kTouches = 0.9;
constexpr double kLeastRadius_m = 1e-4;

/// Radius of the ball inside that touches the surface at `p`, where the outward normal is `normal`.
double touching_radius_m(const SignedDistance& body, const Vec3& p, const Vec3& normal) {
  double low_m = 0.0, high_m = 0.5 * body.box().diagonal().norm();
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    (-body(p - middle_m * normal) >= kTouches * middle_m ? low_m : high_m) = middle_m;
  }
  return std::max(low_m, kLeastRadius_m);
}

/// Of all balls, those within the reach counting most.
double mean_radius_m(const std::vector<TouchingBall>& balls, const Vec3& p, double reach_m) {
  double sum = 0.0, weights = 0.0;
  for (const auto& [place_m, radius_m] : balls) {
    const double away = (p - place_m).squaredNorm() / (reach_m * reach_m);
    const double weight = 1.0 / ((1.0 + away) * (1.0 + away) * (1.0 + away));
    sum += weight * radius_m;
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

std::vector<TouchingBall> touching_balls(const SignedDistance& body) {
  const geometry::TriangleMesh& surface = body.surface();
  const std::size_t stride = 1 + surface.triangles.size() / kSamples;
  std::vector<TouchingBall> balls;
  for (std::size_t t = 0; t < surface.triangles.size(); t += stride) {
    const auto& [a, b, c] = surface.triangles[t];
    const auto place = [&](int v) -> const Vec3& { return surface.positions_m[static_cast<std::size_t>(v)]; };
    const Vec3 centre_m = (place(a) + place(b) + place(c)) / 3.0;
    const Vec3 normal = (place(b) - place(a)).cross(place(c) - place(a)).normalized();
    balls.push_back({centre_m, touching_radius_m(body, centre_m, normal)});
  }
  return balls;
}

LocalRadius::LocalRadius(const SignedDistance& body) {
  const Eigen::AlignedBox3d& box = body.box();
  spacing_m_ = box.sizes().maxCoeff() / kNodesAlong;
  origin_m_ = box.min() - Vec3::Constant(0.5 * spacing_m_);
  counts_ = (box.sizes() / spacing_m_).array().ceil().cast<int>() + 2;
  radii_m_.assign(static_cast<std::size_t>(counts_.prod()), 0.0);

  const std::vector<TouchingBall> balls = touching_balls(body);
  for (int x = 0; x < counts_[0]; ++x) {
    for (int y = 0; y < counts_[1]; ++y) {
      for (int z = 0; z < counts_[2]; ++z) {
        const Vec3 p = origin_m_ + spacing_m_ * Vec3(x, y, z);
        if (box.exteriorDistance(p) > spacing_m_) continue;
        radii_m_[number_of({x, y, z})] = mean_radius_m(balls, p, spacing_m_);
      }
    }
  }
}

std::size_t LocalRadius::number_of(const Eigen::Array3i& node) const {
  const Eigen::Array<std::size_t, 3, 1> n = node.cast<std::size_t>(), counts = counts_.cast<std::size_t>();
  return (n[0] * counts[1] + n[1]) * counts[2] + n[2];
}

double LocalRadius::operator()(const Vec3& p) const {
  const Eigen::Array3d place = (p - origin_m_).array() / spacing_m_;
  const Eigen::Array3i cell = place.floor().cast<int>().max(0).min(counts_ - 2);
  const Eigen::Array3d part = (place - cell.cast<double>()).max(0.0).min(1.0);
  double value_m = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3i step(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    double weight = 1.0;
    for (Eigen::Index k = 0; k < 3; ++k) weight *= step[k] == 1 ? part[k] : 1.0 - part[k];
    value_m += weight * radii_m_[number_of(cell + step)];
  }
  return std::max(value_m, kLeastRadius_m);
}

}  // namespace myotact::prepare
