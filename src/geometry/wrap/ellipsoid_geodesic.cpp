#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "geometry/wrap/geodesic.h"

namespace myotact::geometry {
namespace {

/// Steps of the integration along a geodesic. Measured over random strings at radii of up to 1 : 4: at worst 6e-9 of
/// the length is wrong with 32 steps, 5e-10 with 48, in half as much time again.
constexpr int kSteps = 48;
constexpr int kMostRounds = 30;  // of the search; four to seven are usual
/// Steps from a sphere to the ellipsoid where the search fails at once.
constexpr int kStages = 16;
/// The string is found when it misses q by this part of the smallest radius.
constexpr double kMiss = 1e-13;
/// A way that ran past q is cut back so far behind it [of its distance to q].
constexpr double kBackUp = 0.5;
/// The search rotates and lengthens the way by no more than this in a round [rad; largest radii].
constexpr double kLargestRotation_rad = 0.4, kLargestStep = 0.5;

/// A point that follows a geodesic, with the fields of its neighbours (Geodesic).
struct Walker {
  Vec3 x, v;
  double spread, spread_rate, reach, reach_rate;
  double arc;

  Walker plus(double h, const Walker& rate) const {
    return {x + h * rate.x,           v + h * rate.v,
            spread + h * rate.spread, spread_rate + h * rate.spread_rate,
            reach + h * rate.reach,   reach_rate + h * rate.reach_rate,
            arc + h * rate.arc};
  }
};

/// x^T W x = 1, so that W x is normal to the surface.
class Ellipsoid {
 public:
  explicit Ellipsoid(const Vec3& radii) : weights_(radii.cwiseAbs2().cwiseInverse()), product_(weights_.prod()) {}

  Vec3 steep(const Vec3& x) const { return weights_.cwiseProduct(x); }
  Vec3 normal(const Vec3& x) const { return steep(x).normalized(); }

  /// Along a geodesic the acceleration is normal: x'' = -(v W v)/(x W^2 x) W x. Neighbours: J'' = -K J with the
  /// Gaussian curvature K = det W / (x W^2 x)^2. Rates by time.
  Walker rate(const Walker& w) const {
    const Vec3 up = steep(w.x);
    const double squared = up.squaredNorm(), pace = std::sqrt(squared);
    const double curvature = product_ / (squared * squared);
    return {pace * w.v,
            -(pace * w.v.dot(steep(w.v)) / squared) * up,
            pace * w.spread_rate,
            -pace * curvature * w.spread,
            pace * w.reach_rate,
            -pace * curvature * w.reach,
            pace};
  }

  /// Arc a unit of time. |W x| is what makes an ellipse, run along, a harmonic motion: long steps where it is flat,
  /// short ones round its tips.
  double pace(const Vec3& x) const { return steep(x).norm(); }

  /// Follows the geodesic for `time`. Butcher's sixth-order Runge-Kutta rule (J. Aust. Math. Soc. 4, 179, 1964).
  Walker stepped(const Walker& w, double time) const {
    constexpr std::array<std::array<double, 6>, 7> kA = {
        {{},
         {1.0 / 3},
         {0.0, 2.0 / 3},
         {1.0 / 12, 1.0 / 3, -1.0 / 12},
         {-1.0 / 16, 9.0 / 8, -3.0 / 16, -3.0 / 8},
         {0.0, 9.0 / 8, -3.0 / 8, -3.0 / 4, 1.0 / 2},
         {9.0 / 44, -9.0 / 11, 63.0 / 44, 18.0 / 11, 0.0, -16.0 / 11}}};
    constexpr std::array<double, 7> kB = {11.0 / 120, 0.0, 27.0 / 40, 27.0 / 40, -4.0 / 15, -4.0 / 15, 11.0 / 120};
    std::array<Walker, 7> k;
    for (std::size_t stage = 0; stage < k.size(); ++stage) {
      Walker there = w;
      for (std::size_t before = 0; before < stage; ++before) there = there.plus(time * kA[stage][before], k[before]);
      k[stage] = rate(there);
    }
    Walker after = w;
    for (std::size_t stage = 0; stage < k.size(); ++stage) after = after.plus(time * kB[stage], k[stage]);
    return after;
  }

 private:
  Vec3 weights_;
  double product_;
};

/// Where strings from a point touch the ellipsoid: in the space where it is a unit sphere, a circle.
struct Contour {
  Vec3 radii, middle, first, second;  // the last three in the space of the sphere

  /// At angle_rad 0 through `touch`, a point of the unit sphere.
  Contour(const Vec3& radii_m, const Vec3& p_m, const Vec3& touch) : radii(radii_m) {
    const Vec3 p = p_m.cwiseQuotient(radii_m);
    middle = p / p.squaredNorm();
    first = touch - middle;
    second = p.normalized().cross(first);
  }

  Vec3 at(double angle_rad) const {
    return radii.cwiseProduct(middle + std::cos(angle_rad) * first + std::sin(angle_rad) * second);
  }
  Vec3 slope(double angle_rad) const {
    return radii.cwiseProduct(std::cos(angle_rad) * second - std::sin(angle_rad) * first);
  }
};

struct Ends {
  Vec3 p, q;
};

Walker set_out(const Vec3& x, const Vec3& v) {
  return {x, v, 1.0, 0.0, 0.0, 1.0, 0.0};
}

/// Follows the string from p that touches the surface at `touch` and stays on it for `time`.
Geodesic shoot(const Ellipsoid& ellipsoid, const Ends& ends, const Vec3& touch, double time) {
  Geodesic way;
  way.start_m = touch;
  way.start_normal = ellipsoid.normal(touch);
  way.start_direction = (touch - ends.p).normalized();
  Walker end = set_out(way.start_m, way.start_direction);
  for (int step = 0; step < kSteps; ++step) end = ellipsoid.stepped(end, time / kSteps);
  way.time = time;
  way.length_m = end.arc;
  way.end_m = end.x;
  way.end_direction = end.v.normalized();
  way.end_normal = ellipsoid.normal(end.x);
  way.spread = end.spread;
  way.spread_rate_1_m = end.spread_rate;
  way.reach_m = end.reach;
  way.reach_rate = end.reach_rate;
  return way;
}

/// What a round of the search changes.
struct Correction {
  double angle_rad = 0.0, arc = 0.0, miss = 0.0;
};

/// Newton's step towards a string that hits q: sideways by rotating the start on its contour, up and down by leaving
/// the surface later.
Correction correction(const Ellipsoid& ellipsoid, const Ends& ends, const Geodesic& way, const Vec3& start_slope) {
  const Vec3 start_side = way.start_normal.cross(way.start_direction);
  const Vec3 side = way.end_normal.cross(way.end_direction);
  const double shift = start_side.dot(start_slope);
  const double swing = shift / (way.start_m - ends.p).norm();
  const double end_shift = shift * way.spread + swing * way.reach_m;
  const double end_swing = shift * way.spread_rate_1_m + swing * way.reach_rate;
  const Vec3 left = ends.q - way.end_m;
  const double ahead = left.dot(way.end_direction);
  if (!(ahead > 0.0)) return {0.0, ahead - kBackUp * left.norm(), 1e300};  // ran past q
  const Vec3 steep = ellipsoid.steep(way.end_direction) / ellipsoid.steep(way.end_m).norm();
  const double bend = steep.dot(way.end_direction), twist = steep.dot(side);
  Correction c;
  const double up = left.dot(way.end_normal), sideways = left.dot(side);
  c.miss = std::hypot(up, sideways);
  c.angle_rad = sideways / (end_shift + ahead * end_swing);
  c.arc = -up / (bend * ahead) - (way.start_direction.dot(start_slope) + twist * end_shift / bend) * c.angle_rad;
  return c;
}

/// Time that the image of the way on the unit sphere takes on the ellipsoid.
double first_time(const Ellipsoid& ellipsoid, const Vec3& radii, const Geodesic& on_sphere) {
  constexpr int kPieces = 16;
  double sum = 0.0;
  Vec3 before = on_sphere.start_m;
  for (int i = 1; i <= kPieces; ++i) {
    const Vec3 here = place_on_sphere(on_sphere, on_sphere.length_m * i / kPieces);
    sum += radii.cwiseProduct(here - before).norm() / ellipsoid.pace(radii.cwiseProduct(here));
    before = here;
  }
  return sum;
}

/// The search's unknowns.
struct Course {
  double angle_rad = 0.0, time = 0.0;
};

Geodesic search(const Vec3& radii, const Vec3& p_scaled, const Vec3& q_scaled, const Vec3& touch_scaled,
                Course& course) {
  const Ellipsoid ellipsoid(radii);
  const Ends ends{radii.cwiseProduct(p_scaled), radii.cwiseProduct(q_scaled)};
  const Contour contour(radii, ends.p, touch_scaled);
  const double close = kMiss * radii.minCoeff(), largest_step = kLargestStep * radii.maxCoeff();
  Geodesic best;
  double best_miss = 1e300;
  Course now = course;
  for (int round = 0; round < kMostRounds && !(best_miss <= close); ++round) {
    const Geodesic way = shoot(ellipsoid, ends, contour.at(now.angle_rad), now.time);
    const Correction c = correction(ellipsoid, ends, way, contour.slope(now.angle_rad));
    if (c.miss < best_miss) best_miss = c.miss, best = way, course = now;
    if (!std::isfinite(c.angle_rad) || !std::isfinite(c.arc)) break;
    now.angle_rad += std::clamp(c.angle_rad, -kLargestRotation_rad, kLargestRotation_rad);
    now.time = std::max(0.0, now.time + std::clamp(c.arc, -largest_step, largest_step) / ellipsoid.pace(way.end_m));
  }
  best.holds = best_miss <= 1e4 * close;
  return best;
}

}  // namespace

// Straight lines and planes through the centre stay such in the space where the ellipsoid is a sphere: what clears the
// surface, and on which side, is decided there; its great circle is where the search for the geodesic begins. Where
// that is too far, the sphere is drawn out into the ellipsoid little by little.
std::optional<Geodesic> geodesic_on_ellipsoid(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m) {
  const Vec3& radii = surface.radii_m;
  const Vec3 p = p_m.cwiseQuotient(radii), q = q_m.cwiseQuotient(radii);
  const WrapSurface sphere{WrapShape::Sphere, Vec3::Ones(), surface.side.cwiseQuotient(radii)};
  const auto guess = geodesic_on_sphere(sphere, p, q);
  if (!guess) return std::nullopt;
  Course course{0.0, first_time(Ellipsoid(radii), radii, *guess)};
  Geodesic way = search(radii, p, q, guess->start_m, course);
  if (way.holds) {
    way.holds = guess->holds;
    return way;
  }
  const Vec3 round_m = Vec3::Constant(std::cbrt(radii.prod()));
  course = {0.0, first_time(Ellipsoid(round_m), round_m, *guess)};
  for (int stage = 1; stage <= kStages; ++stage) {
    const double share = static_cast<double>(stage) / kStages;
    way = search(round_m + share * (radii - round_m), p, q, guess->start_m, course);
  }
  way.holds &= guess->holds;
  return way;
}

Vec3 place_on_ellipsoid(const WrapSurface& surface, const Geodesic& way, double arc_m) {
  const Ellipsoid ellipsoid(surface.radii_m);
  const double dt = way.time / kSteps;
  Walker here = set_out(way.start_m, way.start_direction);
  for (int step = 0; step < kSteps; ++step) {
    const Walker next = ellipsoid.stepped(here, dt);
    if (next.arc >= arc_m) break;
    here = next;
  }
  // Within a step: twice Newton for the time.
  double part = (arc_m - here.arc) / ellipsoid.pace(here.x);
  for (int round = 0; round < 2; ++round) {
    const Walker there = ellipsoid.stepped(here, part);
    part += (arc_m - there.arc) / ellipsoid.pace(there.x);
  }
  return ellipsoid.stepped(here, part).x;
}

}  // namespace myotact::geometry
