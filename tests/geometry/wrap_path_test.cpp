#include "geometry/wrap/wrap_path.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

// Strings round surfaces against closed forms, published geodesics, invariants and central differences.

namespace myotact::geometry {
namespace {

constexpr double kPi = std::numbers::pi;

WrapSurface cylinder(double radius_m) {
  return {WrapShape::Cylinder, Vec3::Constant(radius_m), Vec3::UnitX()};
}
WrapSurface sphere(double radius_m) {
  return {WrapShape::Sphere, Vec3::Constant(radius_m), Vec3::UnitX()};
}
WrapSurface ellipsoid(const Vec3& radii_m) {
  return {WrapShape::Ellipsoid, radii_m, Vec3::UnitX()};
}

/// Tangents and arc at planar distances a, b and angle phi between them.
double planar_length(double a, double b, double phi, double radius) {
  return std::sqrt(a * a - radius * radius) + std::sqrt(b * b - radius * radius) +
         radius * (phi - std::acos(radius / a) - std::acos(radius / b));
}

Vec3 polar(double r, double angle, double z = 0.0) {
  return {r * std::cos(angle), r * std::sin(angle), z};
}

TEST(WrapPath, CylinderIsTangentsAndAnArcUnrolled) {
  for (const double phi : {2.6, 3.0, 4.0, 5.5}) {
    const Vec3 p = polar(0.08, 0.5 * phi, 0.01), q = polar(0.03, -0.5 * phi, -0.025);
    const WrapPath path = wrap_path(cylinder(0.0117), p, q);
    EXPECT_TRUE(path.wrapped && path.clears);
    EXPECT_NEAR(path.length_m, std::hypot(planar_length(0.08, 0.03, phi, 0.0117), 0.035), 1e-15) << phi;
  }
}

TEST(WrapPath, SphereIsTangentsAndAGreatCircle) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()));
  for (const double phi : {2.4, 3.0, 4.0}) {
    WrapSurface ball = sphere(0.02);
    ball.side = turn * ball.side;
    const WrapPath path = wrap_path(ball, turn * polar(0.08, 0.5 * phi), turn * polar(0.03, -0.5 * phi));
    EXPECT_TRUE(path.wrapped);
    EXPECT_NEAR(path.length_m, planar_length(0.08, 0.03, phi, 0.02), 1e-15) << phi;
  }
}

TEST(WrapPath, AnEllipsoidOfEqualRadiiIsASphere) {
  const Vec3 p(-0.01, 0.05, 0.012), q(0.002, -0.04, -0.03);
  const WrapPath ball = wrap_path(sphere(0.02), p, q), same = wrap_path(ellipsoid(Vec3::Constant(0.02)), p, q);
  EXPECT_TRUE(ball.wrapped && same.wrapped);
  EXPECT_NEAR(same.length_m, ball.length_m, 1e-9 * ball.length_m);
  EXPECT_LT((same.slope_p - ball.slope_p).norm() + (same.slope_q - ball.slope_q).norm(), 1e-10);
  EXPECT_LT((same.bend_pp_1_m - ball.bend_pp_1_m).norm() + (same.bend_pq_1_m - ball.bend_pq_1_m).norm(), 1e-7);
}

// In a plane of symmetry the geodesic is the ellipse itself; its arcs are elliptic integrals of the second kind.
TEST(WrapPath, EllipsoidInItsPlaneOfSymmetryFollowsTheEllipse) {
  const double major = 0.03, minor = 0.012;
  const WrapSurface egg = ellipsoid({minor, major, 0.02});
  // Tangents at eccentric angles e and -e from the side, left by a straight length of 20 mm.
  for (const double e : {0.3, 0.9, 1.3}) {
    const Vec3 touch(minor * std::cos(e), major * std::sin(e), 0.0);
    const Vec3 back = Vec3(-minor * std::sin(e), major * std::cos(e), 0.0).normalized();
    const Vec3 p = touch + 0.02 * back, q = p.cwiseProduct(Vec3(1, -1, 1));
    // The eccentric angle counts from the minor axis: ds = major sqrt(1 - k^2 sin^2) de.
    const double k = std::sqrt(1.0 - minor * minor / (major * major));
    const WrapPath path = wrap_path(egg, p, q);
    EXPECT_TRUE(path.wrapped);
    EXPECT_NEAR(path.length_m, 0.04 + 2.0 * major * std::ellint_2(k, e), 1e-9 * path.length_m) << e;
  }
}

// Kennedy airport to Changi airport over the earth's ellipsoid: 15347628 m, 3 deg 18' 29.9" and 177 deg 29' 09.2"
// (GeographicLib's manual page of GeodSolve). An end straight above the ground at 1 mm adds less than a millimetre.
TEST(WrapPath, TheEarthsGeodesicsAreThePublishedOnes) {
  const double a = 6378137.0, f = 1.0 / 298.257223563, e2 = f * (2.0 - f);
  const auto place = [&](double latitude_deg, double longitude_deg) {
    const double b = latitude_deg * kPi / 180.0, l = longitude_deg * kPi / 180.0;
    const double n = a / std::sqrt(1.0 - e2 * std::sin(b) * std::sin(b)), h = 1e-3;
    return Vec3((n + h) * std::cos(b) * std::cos(l), (n + h) * std::cos(b) * std::sin(l),
                (n * (1.0 - e2) + h) * std::sin(b));
  };
  const double jfk_latitude = 40.0 + 38.0 / 60 + 23.0 / 3600, jfk_longitude = -(73.0 + 46.0 / 60 + 44.0 / 3600);
  WrapSurface earth = ellipsoid({a, a, a * (1.0 - f)});
  earth.side = Vec3::UnitZ();  // the way leads over the Arctic
  const Vec3 p = place(jfk_latitude, jfk_longitude);
  const WrapPath path = wrap_path(earth, p, place(1.0 + 21.0 / 60 + 33.0 / 3600, 103.0 + 59.0 / 60 + 22.0 / 3600));
  EXPECT_NEAR(path.length_m, 15347628.0, 0.6);
  const double b = jfk_latitude * kPi / 180.0, l = jfk_longitude * kPi / 180.0;
  const Vec3 north(-std::sin(b) * std::cos(l), -std::sin(b) * std::sin(l), std::cos(b));
  const Vec3 east(-std::sin(l), std::cos(l), 0.0);
  const double azimuth_deg = std::atan2(-path.slope_p.dot(east), -path.slope_p.dot(north)) * 180.0 / kPi;
  EXPECT_NEAR(azimuth_deg, 3.0 + 18.0 / 60 + 29.9 / 3600, 0.1 / 3600);
}

// ---- random strings

struct Example {
  WrapSurface surface;
  Vec3 p, q;
};

/// A surface of 5 to 25 mm and ends 5 to 60 mm outside it, all round.
class Examples {
 public:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    Vec3 d;
    do {
      d = Vec3(normal(random_), normal(random_), normal(random_));
    } while (d.norm() < 0.1);
    return d.normalized();
  }
  /// The segment passes near the surface, on either side of it.
  Example next(WrapShape shape) {
    Example e;
    e.surface.shape = shape;
    e.surface.radii_m = Vec3::Constant(between(0.005, 0.025));
    if (shape == WrapShape::Ellipsoid) {
      e.surface.radii_m = Vec3(between(0.0065, 0.025), between(0.0065, 0.025), between(0.0065, 0.025));
    }
    const Vec3 there = direction();
    e.p = end(e.surface, there);
    e.q = end(e.surface, (direction() - there).normalized());
    e.surface.side = ((e.p + e.q).normalized() + 0.7 * direction()).normalized();
    return e;
  }

 private:
  Vec3 end(const WrapSurface& surface, const Vec3& d) {
    if (surface.shape == WrapShape::Cylinder) {
      const Vec3 flat = Vec3(d.x(), d.y(), 0.0).normalized();
      return flat * (surface.radii_m[0] + between(0.005, 0.06)) + Vec3(0, 0, between(-0.05, 0.05));
    }
    return surface.radii_m.cwiseProduct(d) + between(0.005, 0.06) * d;
  }
  std::mt19937 random_{7};
};

class EveryShape : public ::testing::TestWithParam<WrapShape> {};
INSTANTIATE_TEST_SUITE_P(WrapPath, EveryShape,
                         ::testing::Values(WrapShape::Cylinder, WrapShape::Sphere, WrapShape::Ellipsoid));

/// More than half round, a string balances on a sphere and slips at its antipode: no place for differences.
bool beyond_half(const Example& e) {
  if (e.surface.shape == WrapShape::Cylinder) return false;
  const Vec3 p = e.p.cwiseQuotient(e.surface.radii_m).normalized(),
             q = e.q.cwiseQuotient(e.surface.radii_m).normalized();
  const Vec3 s = e.surface.side.cwiseQuotient(e.surface.radii_m), n = p.cross(q);
  return (p.cross(s).dot(n) < 0.0 && s.cross(q).dot(n) < 0.0) || p.dot(q) < -0.97;
}

TEST_P(EveryShape, DerivativesAreThoseOfDifferences) {
  Examples examples;
  int wrapped = 0;
  constexpr double h = 1e-6;
  for (int i = 0; i < 400; ++i) {
    const Example e = examples.next(GetParam());
    if (beyond_half(e)) continue;
    const WrapPath here = wrap_path(e.surface, e.p, e.q);
    ASSERT_TRUE(here.clears) << i;
    wrapped += here.wrapped;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = h * Vec3::Unit(k);
      const WrapPath p_up = wrap_path(e.surface, e.p + step, e.q), p_down = wrap_path(e.surface, e.p - step, e.q);
      const WrapPath q_up = wrap_path(e.surface, e.p, e.q + step), q_down = wrap_path(e.surface, e.p, e.q - step);
      if (p_up.wrapped != p_down.wrapped || q_up.wrapped != q_down.wrapped) continue;
      EXPECT_NEAR(here.slope_p[k], (p_up.length_m - p_down.length_m) / (2 * h), 1e-7) << i;
      EXPECT_NEAR(here.slope_q[k], (q_up.length_m - q_down.length_m) / (2 * h), 1e-7) << i;
      const double size = 1e-6 * (1.0 + here.bend_pp_1_m.norm() + here.bend_qq_1_m.norm());
      EXPECT_LT((here.bend_pp_1_m.col(k) - (p_up.slope_p - p_down.slope_p) / (2 * h)).norm(), size) << i;
      EXPECT_LT((here.bend_pq_1_m.col(k) - (q_up.slope_p - q_down.slope_p) / (2 * h)).norm(), size) << i;
      EXPECT_LT((here.bend_pq_1_m.row(k).transpose() - (p_up.slope_q - p_down.slope_q) / (2 * h)).norm(), size) << i;
      EXPECT_LT((here.bend_qq_1_m.col(k) - (q_up.slope_q - q_down.slope_q) / (2 * h)).norm(), size) << i;
    }
  }
  EXPECT_GT(wrapped, 100);
}

TEST_P(EveryShape, PointsLieEvenlyOnATautStringOutside) {
  Examples examples;
  for (int i = 0; i < 200; ++i) {
    const Example e = examples.next(GetParam());
    std::vector<Vec3> points(199);
    wrap_points(e.surface, e.p, e.q, points);
    points.insert(points.begin(), e.p);
    points.push_back(e.q);
    const double length = wrap_path(e.surface, e.p, e.q).length_m;
    for (std::size_t k = 1; k < points.size(); ++k) {
      EXPECT_FALSE(is_inside(e.surface, points[k] * (1.0 + 1e-9))) << i;
      const double piece = (points[k] - points[k - 1]).norm() / (length / 200.0);
      EXPECT_LT(piece, 1.0 + 1e-8) << i;  // a chord of its arc
      EXPECT_GT(piece, 0.98) << i;
    }
  }
}

// Joachimsthal: along a geodesic of a quadric, (v W v)(x W^2 x) keeps its value.
TEST(WrapPath, EllipsoidsKeepTheirInvariant) {
  Examples examples;
  int tested = 0;
  for (int i = 0; i < 1000; ++i) {
    const Example e = examples.next(WrapShape::Ellipsoid);
    const WrapPath path = wrap_path(e.surface, e.p, e.q);
    if (!path.wrapped || beyond_half(e)) continue;
    ++tested;
    EXPECT_TRUE(path.clears) << i;
    const Vec3 w = e.surface.radii_m.cwiseAbs2().cwiseInverse();
    // Where a tangent from `end` along `t` touches: its nearest point to the centre in the metric of W.
    const auto invariant = [&](const Vec3& end, const Vec3& t) {
      const Vec3 x = end - t * (w.cwiseProduct(t).dot(end) / w.cwiseProduct(t).dot(t));
      return t.dot(w.cwiseProduct(t)) * w.cwiseProduct(x).squaredNorm();
    };
    EXPECT_NEAR(invariant(e.p, path.slope_p) / invariant(e.q, path.slope_q), 1.0, 1e-7) << i;
  }
  EXPECT_GT(tested, 300);
}

// An end swings past the surface: length and slope have no step where the string comes off.
TEST_P(EveryShape, LengthAndSlopeAreContinuousThroughLiftOff) {
  const WrapSurface surface{GetParam(),
                            GetParam() == WrapShape::Ellipsoid ? Vec3(0.008, 0.014, 0.011) : Vec3::Constant(0.011),
                            Vec3::UnitX()};
  const Vec3 p(0.004, 0.06, 0.003);
  int changes = 0;
  WrapPath before = wrap_path(surface, p, Vec3(0.0, -0.03, 0.004));
  constexpr int kSamples = 4000;
  for (int i = 1; i <= kSamples; ++i) {
    const double x = 0.04 * i / kSamples;
    const WrapPath now = wrap_path(surface, p, Vec3(x, -0.03, 0.004));
    const double step = 0.04 / kSamples;
    EXPECT_LE(std::abs(now.length_m - before.length_m), step * (1 + 1e-9)) << x;
    const double steepest_1_m = std::max(now.bend_qq_1_m.norm(), before.bend_qq_1_m.norm());
    EXPECT_LT((now.slope_q - before.slope_q).norm(), 1.01 * steepest_1_m * step) << x;
    changes += now.wrapped != before.wrapped;
    before = now;
  }
  EXPECT_EQ(changes, 1);
}

// The side decides, not the shorter way: a segment that passes clear of the surface on its far side goes round.
TEST_P(EveryShape, ALineNeverJumpsAcross) {
  const WrapSurface surface{GetParam(),
                            GetParam() == WrapShape::Ellipsoid ? Vec3(0.008, 0.014, 0.011) : Vec3::Constant(0.011),
                            Vec3::UnitX()};
  double before = 0.0;
  for (int i = 0; i <= 400; ++i) {
    const double x = 0.03 - 0.06 * i / 400;
    const WrapPath path = wrap_path(surface, Vec3(x, 0.05, 0.0), Vec3(x, -0.05, 0.0));
    if (x < -0.02) {
      EXPECT_TRUE(path.wrapped) << x;
      EXPECT_EQ(path.clears, GetParam() == WrapShape::Cylinder);  // balanced on the others
    }
    if (i > 0) {
      EXPECT_LT(std::abs(path.length_m - before), 4e-4) << x;
    }
    before = path.length_m;
  }
}

TEST_P(EveryShape, AnEndInsideIsToldAndLeavesNoStep) {
  const WrapSurface surface{GetParam(),
                            GetParam() == WrapShape::Ellipsoid ? Vec3(0.008, 0.014, 0.011) : Vec3::Constant(0.011),
                            Vec3::UnitX()};
  const Vec3 p(0.004, 0.06, 0.003), direction = Vec3(0.2, -0.8, 0.1).normalized();
  double before = 0.0;
  for (int i = 0; i <= 3000; ++i) {
    const Vec3 q = direction * (0.03 - 0.03 * i / 3000);
    const WrapPath path = wrap_path(surface, p, q);
    EXPECT_EQ(path.clears, !is_inside(surface, q));
    EXPECT_TRUE(std::isfinite(path.length_m) && path.slope_q.allFinite() && path.bend_qq_1_m.allFinite());
    if (i > 0 && i < 3000) {
      EXPECT_LT(std::abs(path.length_m - before), 2e-5) << i;
    }
    before = path.length_m;
  }
}

TEST_P(EveryShape, SingularPlacesGiveNumbers) {
  const WrapSurface surface{GetParam(),
                            GetParam() == WrapShape::Ellipsoid ? Vec3(0.008, 0.014, 0.011) : Vec3::Constant(0.011),
                            Vec3::UnitX()};
  const double r = surface.radii_m[1];
  const std::vector<Vec3> places = {{0, 0, 0}, {0, r, 0},  {0, -r, 0},   {0, 0.03, 0}, {0, -0.03, 0},
                                    {1, 0, 0}, {-1, 0, 0}, {0, 0, 0.05}, {0, 0, -0.05}};
  for (const Vec3& p : places) {
    for (const Vec3& q : places) {
      const WrapPath path = wrap_path(surface, p, q);
      const bool finite = std::isfinite(path.length_m) && path.slope_p.allFinite() && path.slope_q.allFinite() &&
                          path.bend_pp_1_m.allFinite() && path.bend_pq_1_m.allFinite() && path.bend_qq_1_m.allFinite();
      EXPECT_TRUE(finite) << p.transpose() << " to " << q.transpose();
    }
  }
}

}  // namespace
}  // namespace myotact::geometry
