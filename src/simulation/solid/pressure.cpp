#include "simulation/solid/pressure.h"

#include <Eigen/Geometry>

namespace myotact::simulation {
namespace {

struct SurfacePoint {
  double weight = 0.0;
  std::array<double, 6> value{}, along{}, across{};  // shape functions and their slopes against the two coordinates
};

SurfacePoint surface_point(double r, double s, double weight, bool quadratic) {
  const double t = 1.0 - r - s;
  if (!quadratic) return {weight, {t, r, s, 0, 0, 0}, {-1, 1, 0, 0, 0, 0}, {-1, 0, 1, 0, 0, 0}};
  return {weight,
          {t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * t * r, 4 * r * s, 4 * s * t},
          {1 - 4 * t, 4 * r - 1, 0, 4 * (t - r), 4 * s, -4 * s},
          {1 - 4 * t, 0, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)}};
}

/// Six points, exact to degree 4 (Dunavant 1985): what quadratic triangles need.
std::array<SurfacePoint, 6> surface_points(bool quadratic) {
  constexpr double a = 0.445948490915965, wa = 0.5 * 0.223381589678011;
  constexpr double b = 0.091576213509771, wb = 0.5 * 0.109951743655322;
  return {surface_point(a, a, wa, quadratic),         surface_point(1 - 2 * a, a, wa, quadratic),
          surface_point(a, 1 - 2 * a, wa, quadratic), surface_point(b, b, wb, quadratic),
          surface_point(1 - 2 * b, b, wb, quadratic), surface_point(b, 1 - 2 * b, wb, quadratic)};
}

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

void add_pressure(const PressureFace& face, double load, const Eigen::VectorXd& position_m, bool tangent,
                  Solid::Evaluation& out) {
  const std::size_t count = face.quadratic ? 6 : 3;
  const double pressure = load * face.pressure_Pa;
  std::array<std::array<Mat3, 6>, 6> slope;
  for (auto& row : slope) row.fill(Mat3::Zero());
  for (const SurfacePoint& point : surface_points(face.quadratic)) {
    Vec3 along = Vec3::Zero(), across = Vec3::Zero();
    for (std::size_t a = 0; a < count; ++a) {
      along += point.along[a] * position_m.segment<3>(3 * face.nodes[a]);
      across += point.across[a] * position_m.segment<3>(3 * face.nodes[a]);
    }
    const Vec3 normal = along.cross(across);
    for (std::size_t a = 0; a < count; ++a) {
      const double share = pressure * point.weight * point.value[a];
      out.force_N.segment<3>(3 * face.nodes[a]) += share * normal;
      for (std::size_t b = 0; tangent && b < count; ++b) {
        slope[a][b] += share * (point.across[b] * cross_matrix(along) - point.along[b] * cross_matrix(across));
      }
    }
  }
  for (std::size_t a = 0; tangent && a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      if (face.nodes[a] < face.nodes[b]) continue;
      out.stiffness.add(face.nodes[a], face.nodes[b], 0.5 * (slope[a][b] + slope[b][a].transpose()));
    }
  }
}

}  // namespace myotact::simulation
