#include "anatomy/find_wrap_defects.h"

#include <cmath>

#include <fmt/format.h>

#include "anatomy/farthest.h"
#include "core/text.h"

namespace myotact::anatomy {
namespace {

using geometry::WrapShape;

/// Smaller than a tendon's own radius, larger than any bone of a limb [m].
constexpr double kSmallest_m = 1e-4, kLargest_m = 0.2;
constexpr double kUnitTolerance = 1e-6;  // files give at least seven digits
/// A cylinder's side must point this much across its axis (sine), or it names no side.
constexpr double kLeastAcross = 0.1;

std::string defect_of_shape(const LineWrap& wrap) {
  for (int k = 0; k < 3; ++k) {
    const double radius_m = wrap.radii_m[k];
    if (!(radius_m >= kSmallest_m && radius_m <= kLargest_m)) {
      return fmt::format("a radius is {} m; must be between {} and {}", to_text(radius_m), to_text(kSmallest_m),
                         to_text(kLargest_m));
    }
  }
  const double elongation = wrap.radii_m.maxCoeff() / wrap.radii_m.minCoeff();
  if (elongation > geometry::kMostElongated) {
    return fmt::format("its largest radius is {} times its smallest; must be at most {}", to_text(elongation),
                       to_text(geometry::kMostElongated));
  }
  if (!is_near(wrap.centre_m)) {
    return "centre_m must lie within 10 m; are the units metres?";
  }
  if (!((wrap.axes * wrap.axes.transpose() - Mat3::Identity()).norm() <= 10.0 * kUnitTolerance)) {
    return "its axes must be of length 1 and at right angles";
  }
  if (!(std::abs(wrap.side.norm() - 1.0) <= kUnitTolerance)) return "side must be of length 1";
  const Vec3 side = wrap.axes * wrap.side;
  if (wrap.shape == WrapShape::Cylinder && !(std::hypot(side.x(), side.y()) >= kLeastAcross)) {
    return "side points along the axis; must point across it, to where the line passes";
  }
  return "";
}

std::string defect_of_way(const MuscleLine& line, const LineWrap& wrap) {
  const geometry::WrapSurface surface = surface_of(wrap);
  const auto after = static_cast<std::size_t>(wrap.after);
  const Vec3 p = in_frame_of(wrap, line.points[after].position_m);
  const Vec3 q = in_frame_of(wrap, line.points[after + 1].position_m);
  for (const auto& [end, index] : {std::pair{p, after}, std::pair{q, after + 1}}) {
    if (!is_inside(surface, end)) continue;
    return fmt::format("point {} of the line lies inside it; move the point or make the surface smaller", index);
  }
  if (!geometry::wrap_path(surface, p, q).clears) {
    return fmt::format(
        "the line goes more than half round it between points {} and {} and would slip off; set its side "
        "to where the line passes, or make it smaller",
        after, after + 1);
  }
  return "";
}

}  // namespace

std::vector<std::string> find_wrap_defects(const MuscleLine& line, const std::string& name) {
  std::vector<std::string> defects;
  for (std::size_t w = 0; w < line.wraps.size(); ++w) {
    const LineWrap& wrap = line.wraps[w];
    const int segments = static_cast<int>(line.points.size()) - 1;
    if (wrap.after < 0 || wrap.after >= segments) {
      defects.push_back(fmt::format("{}: wrap {}: after is {}; must be 0 .. {}, a point with one after it", name, w,
                                    wrap.after, segments - 1));
      continue;
    }
    for (std::size_t other = 0; other < w; ++other) {
      if (line.wraps[other].after != wrap.after) continue;
      defects.push_back(
          fmt::format("{}: wraps {} and {} are on the same segment, after point {}; put a via point "
                      "between them or leave one out",
                      name, other, w, wrap.after));
    }
    std::string defect = defect_of_shape(wrap);
    if (defect.empty()) defect = defect_of_way(line, wrap);
    if (!defect.empty()) defects.push_back(fmt::format("{}: wrap {}: {}", name, w, defect));
  }
  return defects;
}

}  // namespace myotact::anatomy
