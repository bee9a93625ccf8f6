#include "prepare/loft/ellipses.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace myotact::prepare {

namespace {

/// Thinner tips than this would only make needles; the belly is 7 to 20 mm.
constexpr double kThinnest_m = 1.5e-3;

/// Catmull-Rom spline through the centres; the ends are doubled.
Vec3 centre_at(const std::vector<Ellipse>& ellipses, std::size_t i, double s) {
  const auto point = [&](std::ptrdiff_t k) -> const Vec3& {
    const auto last = static_cast<std::ptrdiff_t>(ellipses.size()) - 1;
    return ellipses[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(k, 0, last))].centre_m;
  };
  const auto k = static_cast<std::ptrdiff_t>(i);
  const Vec3 a = point(k - 1), b = point(k), c = point(k + 1), d = point(k + 2);
  return 0.5 *
         (2.0 * b + s * (c - a) + s * s * (2.0 * a - 5.0 * b + 4.0 * c - d) + s * s * s * (3.0 * b - 3.0 * c + d - a));
}

/// The ellipses again, closer together: centres on a spline, shapes between neighbours.
std::vector<Ellipse> resample(const std::vector<Ellipse>& ellipses, double spacing_m) {
  std::vector<Ellipse> fine;
  for (std::size_t i = 0; i + 1 < ellipses.size(); ++i) {
    const double length = (ellipses[i + 1].centre_m - ellipses[i].centre_m).norm();
    const int parts = std::max(1, static_cast<int>(std::lround(length / spacing_m)));
    for (int k = 0; k < parts; ++k) {
      const double s = static_cast<double>(k) / parts;
      fine.push_back({centre_at(ellipses, i, s), (1.0 - s) * ellipses[i].shape_m2 + s * ellipses[i + 1].shape_m2});
    }
  }
  fine.push_back(ellipses.back());
  return fine;
}

/// Points centre + sqrt(S) (cos t, sin t), with S the shape seen in the plane of e1 and e2.
Ring ring_of(const Ellipse& ellipse, const Vec3& e1, const Vec3& e2, int around) {
  Eigen::Matrix<double, 3, 2> plane;
  plane << e1, e2;
  const Eigen::Matrix2d in_plane = plane.transpose() * ellipse.shape_m2 * plane;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> parts(in_plane);
  const Eigen::Vector2d radii = parts.eigenvalues().cwiseMax(kThinnest_m * kThinnest_m).cwiseSqrt();
  const Eigen::Matrix2d root = parts.eigenvectors() * radii.asDiagonal() * parts.eigenvectors().transpose();
  Ring ring;
  for (int j = 0; j < around; ++j) {
    const double t = 2.0 * std::numbers::pi * j / around;
    ring.push_back(ellipse.centre_m + plane * (root * Eigen::Vector2d(std::cos(t), std::sin(t))));
  }
  return ring;
}

}  // namespace

Ellipse read_ellipse(const JsonValue& value) {
  constexpr double kWidest_m = 0.2;
  JsonObject fields(value);
  Ellipse ellipse;
  ellipse.centre_m = fields.at("centre_m").vec3();
  const Vec3 major = fields.at("major").vec3().normalized();
  const Vec3 minor = fields.at("minor").vec3().normalized();
  const double a = fields.at("a_m").number_between(1e-5, kWidest_m);
  const double b = fields.at("b_m").number_between(1e-5, kWidest_m);
  fields.finish();
  ellipse.shape_m2 = a * a * major * major.transpose() + b * b * minor * minor.transpose();
  return ellipse;
}

geometry::TriangleMesh loft_ellipses(const std::vector<Ellipse>& ellipses, const Vec3& first_tip, const Vec3& last_tip,
                                     double spacing_m, int around) {
  const std::vector<Ellipse> fine = resample(ellipses, spacing_m);
  std::vector<Ring> rings;
  Vec3 e1 = Vec3::Zero();
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const Vec3& before = fine[i == 0 ? 0 : i - 1].centre_m;
    const Vec3& after = fine[std::min(i + 1, fine.size() - 1)].centre_m;
    const Vec3 tangent = (after - before).normalized();
    // The start of each ring is carried on from the last one by projection: no twist.
    if (i == 0) e1 = tangent.unitOrthogonal();
    e1 = (e1 - tangent.dot(e1) * tangent).normalized();
    rings.push_back(ring_of(fine[i], e1, tangent.cross(e1), around));
  }
  return join_rings(rings, first_tip, last_tip);
}

}  // namespace myotact::prepare
