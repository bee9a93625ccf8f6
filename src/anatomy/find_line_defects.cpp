#include "anatomy/find_line_defects.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "anatomy/farthest.h"
#include "anatomy/find_wrap_defects.h"
#include "geometry/depth_inside.h"

namespace myotact::anatomy {
namespace {

/// The first thing that is wrong with the points by themselves.
std::string defect_of_points(const MuscleLine& line) {
  if (line.points.size() < 2) return "needs at least two points";
  if (line.points.front().kind != LinePointKind::Origin || line.points.back().kind != LinePointKind::Insertion) {
    return "must begin with an origin and end with an insertion";
  }
  for (std::size_t p = 0; p < line.points.size(); ++p) {
    if (!is_near(line.points[p].position_m)) return fmt::format("point {} must lie within 10 m", p);
    if (p > 0 && line.points[p].position_m == line.points[p - 1].position_m) {
      return fmt::format("points {} and {} are the same; remove one", p - 1, p);
    }
  }
  return "";
}

std::string defect_of_crossing(const MuscleLine& line, const Specimen& specimen) {
  const int body = line.points.front().body;
  const bool crosses =
      std::any_of(line.points.begin(), line.points.end(), [&](const LinePoint& p) { return p.body != body; });
  if (crosses) return "";
  return fmt::format(
      "all its points are on the body {}, so that it crosses no joint and moves nothing; put its insertion on the body "
      "that it moves",
      specimen.bodies[static_cast<std::size_t>(body)].key);
}

void add_buried_points(const MuscleLine& line, const Specimen& specimen, double deepest_via_m,
                       std::vector<std::string>& defects) {
  for (std::size_t p = 0; p < line.points.size(); ++p) {
    if (line.points[p].kind != LinePointKind::Via) continue;
    for (const Bone& bone : specimen.bones) {
      const double depth_m = geometry::depth_inside_m(bone.surface, line.points[p].position_m);
      if (!(depth_m > deepest_via_m)) continue;
      defects.push_back(fmt::format(
          "via point {} lies {:.1f} mm inside the bone {}, at most {:.1f} are allowed; move it out, or lead the line "
          "round the bone by a wrap",
          p, 1e3 * depth_m, bone.key, 1e3 * deepest_via_m));
    }
  }
}

}  // namespace

std::vector<std::string> find_line_defects(const MuscleLine& line, const Specimen& specimen, const LineRules& rules) {
  const std::string name = "line of " + specimen.muscles[static_cast<std::size_t>(line.muscle)].key;
  if (const std::string defect = defect_of_points(line); !defect.empty()) return {name + ": " + defect};
  std::vector<std::string> defects;
  if (rules.crosses_joint) {
    if (const std::string defect = defect_of_crossing(line, specimen); !defect.empty()) defects.push_back(defect);
  }
  add_buried_points(line, specimen, rules.deepest_via_m, defects);
  for (std::string& defect : defects) defect = name + ": " + defect;
  std::vector<std::string> of_wraps = find_wrap_defects(line, name);
  std::move(of_wraps.begin(), of_wraps.end(), std::back_inserter(defects));
  return defects;
}

}  // namespace myotact::anatomy
