#include "geometry/closest_point.h"

namespace myotact::geometry {

TrianglePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const auto at = [&](double v, double w) { return TrianglePoint{a + v * (b - a) + w * (c - a), {1.0 - v - w, v, w}}; };
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, {1.0, 0.0, 0.0}};

  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return {b, {0.0, 1.0, 0.0}};

  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return at(d1 == d3 ? 0.0 : d1 / (d1 - d3), 0.0);

  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return {c, {0.0, 0.0, 1.0}};

  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return at(0.0, d2 == d6 ? 0.0 : d2 / (d2 - d6));

  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    const double total = (d4 - d3) + (d5 - d6);
    const double w = total == 0.0 ? 0.0 : (d4 - d3) / total;
    return at(1.0 - w, w);
  }
  const double sum = va + vb + vc;
  return at(vb / sum, vc / sum);
}

}  // namespace myotact::geometry
