#pragma once

#include <algorithm>
#include <span>

namespace myotact::simulation {

/// A point of a curve and the curve's slope there.
struct Knot {
  double x, y, slope;
};

/// The cubic between two knots of different x. Whole curves have a continuous slope, no continuous curvature.
constexpr double cubic_value(const Knot& a, const Knot& b, double x) noexcept {
  const double h = b.x - a.x;
  const double t = (x - a.x) / h;
  const double from_b = t * t * (3.0 - 2.0 * t);
  return a.y + (b.y - a.y) * from_b + h * t * (1.0 - t) * ((1.0 - t) * a.slope - t * b.slope);
}

/// Its derivative.
constexpr double cubic_slope(const Knot& a, const Knot& b, double x) noexcept {
  const double h = b.x - a.x;
  const double t = (x - a.x) / h;
  const double mean_slope = (b.y - a.y) / h;
  return 6.0 * t * (1.0 - t) * mean_slope + (1.0 - t) * (1.0 - 3.0 * t) * a.slope + t * (3.0 * t - 2.0) * b.slope;
}

/// The curve through two or more knots of rising x, straight beyond the first and the last. Real-time safe.
constexpr double curve_value(std::span<const Knot> knots, double x) noexcept {
  constexpr double kLargestArgument = 1e300;  // straight lines stop growing there, to stay finite
  const Knot& first = knots.front();
  const Knot& last = knots.back();
  if (x <= first.x) return first.y + (std::max(x, -kLargestArgument) - first.x) * first.slope;
  if (x >= last.x) return last.y + (std::min(x, kLargestArgument) - last.x) * last.slope;
  std::size_t i = 1;
  while (knots[i].x < x) ++i;
  return cubic_value(knots[i - 1], knots[i], x);
}

/// Its derivative.
constexpr double curve_slope(std::span<const Knot> knots, double x) noexcept {
  if (x <= knots.front().x) return knots.front().slope;
  if (x >= knots.back().x) return knots.back().slope;
  std::size_t i = 1;
  while (knots[i].x < x) ++i;
  return cubic_slope(knots[i - 1], knots[i], x);
}

/// A knot between a steep and a flat end that takes the inflection out of the single cubic.
///
/// With h the signed way from steep to flat, the curvature runs straight from a value at the steep end to c at the new
/// knot, tau from the steep end, and on to 0 at the flat end. The two ends' heights and slopes leave one of them free:
/// c = 0 would put tau at 3 p / d, with d what the slope changes by and p what the flat end's tangent misses at the
/// steep end; two thirds of that is a gentle bend, and then c = 2 p / h^2.
constexpr Knot smoothing_knot(const Knot& steep, const Knot& flat) noexcept {
  const double h = flat.x - steep.x;
  const double missed = flat.slope * h - (flat.y - steep.y);
  const double tau = 2.0 * missed / (flat.slope - steep.slope);
  const double curvature = 2.0 * missed / (h * h);
  const double rest = h - tau;
  return {steep.x + tau, flat.y - flat.slope * rest + curvature * rest * rest / 6.0,
          flat.slope - 0.5 * curvature * rest};
}

}  // namespace myotact::simulation
