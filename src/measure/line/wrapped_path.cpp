#include "measure/line/wrapped_path.h"

#include <cmath>

namespace myotact::measure {
namespace {

/// A length in the plane and its derivatives by phi.
struct PlaneLength {
  double l, slope, curvature;
};

PlaneLength straight(const WrappedPath& path, double phi_rad) {
  const double ab = path.a_m * path.b_m;
  const double l = std::sqrt(path.a_m * path.a_m + path.b_m * path.b_m - 2.0 * ab * std::cos(phi_rad));
  const double slope = ab * std::sin(phi_rad) / l;
  return {l, slope, (ab * std::cos(phi_rad) - slope * slope) / l};
}

/// Two tangents and an arc between them.
PlaneLength wrapped(const WrappedPath& path, double arc_rad) {
  const double R = path.radius_m;
  const auto tangent_m = [R](double d_m) { return std::sqrt((d_m - R) * (d_m + R)); };
  return {tangent_m(path.a_m) + tangent_m(path.b_m) + R * arc_rad, R, 0.0};
}

}  // namespace

PathGeometry measure_path(const WrappedPath& path, double q_rad) noexcept {
  const double phi_rad = path.phi0_rad + path.sign * q_rad;
  const double arc_rad = phi_rad - std::acos(path.radius_m / path.a_m) - std::acos(path.radius_m / path.b_m);
  const PlaneLength plane = arc_rad > 0.0 ? wrapped(path, arc_rad) : straight(path, phi_rad);
  // With the offset along the axis S^2 = l^2 + offset^2: S S' = l l', S'^2 + S S'' = l'^2 + l l''.
  const double S = std::hypot(plane.l, path.offset_m);
  const double slope = plane.l * plane.slope / S;
  const double curvature = (plane.slope * plane.slope + plane.l * plane.curvature - slope * slope) / S;
  return {path.constant_m + S, -path.sign * slope, -curvature};
}

}  // namespace myotact::measure
