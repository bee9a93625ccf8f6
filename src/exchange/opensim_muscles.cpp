#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "anatomy/find_line_defects.h"
#include "core/at.h"
#include "core/text.h"
#include "exchange/opensim_convert.h"

namespace myotact::exchange::opensim {
namespace {

constexpr anatomy::LineRules kImportedLine{.deepest_via_m = 1.0, .crosses_joint = false};

double coordinate_value(const PoseValues& pose, const std::string& name, const Element& user) {
  const auto found = pose.find(name);
  if (found == pose.end()) {
    throw user.error(fmt::format("names the coordinate \"{}\", which no joint has", name.substr(0, 80)));
  }
  return found->second;
}

/// Where the point is at the file pose, or nothing where it is off then.
std::optional<anatomy::LinePoint> point_at_pose(const PathPoint& point, bool tells, const Placed& placed) {
  Vec3 position_m = point.position_m;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!point.moving[i]) continue;
    const double value = coordinate_value(placed.pose, point.moving[i]->coordinate, point.element);
    position_m[static_cast<Eigen::Index>(i)] = point.moving[i]->function.at(value);
  }
  if (point.condition) {
    const double value = coordinate_value(placed.pose, point.condition->coordinate, point.element);
    const bool on = value >= point.condition->range.first && value <= point.condition->range.second;
    if (tells) {
      point.element.tell(on ? "a point that comes and goes always stays, as it is there at the file pose"
                            : "a point that comes and goes is left out, as it is not there at the file pose");
    }
    if (!on) return std::nullopt;
  }
  return anatomy::LinePoint{point.body, placed.X_LB[at(point.body)] * (point.X_BF * position_m),
                            anatomy::LinePointKind::Via};
}

/// Fibre length over the optimal one where the tendon is just straight and the whole as long as the line.
double rest_stretch_of(const Muscle& muscle, double length_m) {
  const double reach_m = length_m - muscle.tendon_slack_m;
  if (!(reach_m > 0.0)) return 0.0;
  return std::hypot(reach_m, muscle.optimal_fibre_m * std::sin(muscle.pennation_rad)) / muscle.optimal_fibre_m;
}

double length_m(const anatomy::MuscleLine& line) {
  double sum_m = 0.0;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const Vec3 &p = line.points[i].position_m, &q = line.points[i + 1].position_m;
    const anatomy::LineWrap* wrap = anatomy::wrap_after(line, i);
    sum_m += wrap == nullptr
                 ? (q - p).norm()
                 : geometry::wrap_path(surface_of(*wrap), in_frame_of(*wrap, p), in_frame_of(*wrap, q)).length_m;
  }
  return sum_m;
}

anatomy::Muscle mechanics_of(const Muscle& muscle, double rest_stretch, const RawModel& raw) {
  anatomy::Muscle made;
  made.name_la = made.name_en = muscle.name;
  made.material = "muscle";
  made.peak_force_N = muscle.peak_force_N;
  made.optimal_fibre_m = muscle.optimal_fibre_m;
  made.pennation_rad = muscle.pennation_rad;
  made.tendon_slack_m = muscle.tendon_slack_m;
  made.rest_stretch = rest_stretch;
  made.activation_tau_s = muscle.activation_tau_s;
  made.deactivation_tau_s = muscle.deactivation_tau_s;
  made.estimated = {"tets", "skin"};
  made.sources = {raw.name.empty() ? "OpenSim model" : "OpenSim model " + raw.name};
  return made;
}

/// The line, with its path's numbering of points.
anatomy::MuscleLine line_of(const RawModel& raw, const Muscle& muscle, bool tells, const Placed& placed) {
  anatomy::MuscleLine line;
  std::vector<int> numbering;
  for (const PathPoint& point : muscle.points) {
    const auto place = point_at_pose(point, tells, placed);
    const bool again = place && !line.points.empty() && line.points.back().position_m == place->position_m;
    if (place && !again) line.points.push_back(*place);
    numbering.push_back(static_cast<int>(line.points.size()) - 1);
  }
  if (line.points.size() < 2) return line;
  line.points.front().kind = anatomy::LinePointKind::Origin;
  line.points.back().kind = anatomy::LinePointKind::Insertion;
  line.muscle = 0;
  add_wraps(raw, muscle, numbering, placed, line);
  return line;
}

/// Why the line and its muscle cannot be taken; empty: they can.
std::string defect_of(const anatomy::MuscleLine& line, const anatomy::Muscle& muscle, const Placed& placed) {
  anatomy::Specimen alone;
  alone.bodies = placed.specimen.bodies;
  alone.muscles.push_back(muscle);
  const auto of_line = anatomy::find_line_defects(line, alone, kImportedLine);
  if (!of_line.empty()) return of_line.front();
  const auto of_muscle = anatomy::find_defects(muscle, alone.bodies.size());
  return of_muscle.empty() ? "" : of_muscle.front();
}

/// Lengths outside of the curves at the file pose: another pose may suit.
bool fits_pose(const anatomy::Muscle& muscle) {
  constexpr double kShortest = 0.3, kLongest = 1.8;  // of what find_defects() allows
  return muscle.rest_stretch >= kShortest && muscle.rest_stretch <= kLongest &&
         muscle.rest_stretch > std::sin(muscle.pennation_rad);
}

}  // namespace

int add_muscles(const RawModel& raw, bool tells, Placed& placed) {
  int at_fault = 0;
  std::vector<std::string> keys;
  const auto leave = [&](const Muscle& muscle, const std::string& reason) {
    if (tells) muscle.element.leave(reason);
  };
  for (const Muscle& muscle : raw.muscles) {
    if (!(muscle.optimal_fibre_m > 0.0)) {
      throw muscle.element.error("its optimal_fiber_length must be greater than 0");
    }
    anatomy::MuscleLine line = line_of(raw, muscle, tells, placed);
    if (line.points.size() < 2) {
      leave(muscle, "left out: its path has fewer than two points at different places");
      continue;
    }
    anatomy::Muscle made = mechanics_of(muscle, rest_stretch_of(muscle, length_m(line)), raw);
    made.key = key_of(muscle.name, keys);
    if (!fits_pose(made)) {
      ++at_fault;
      leave(muscle,
            fmt::format("left out: with its tendon just straight its fibres are {:.2f} of their optimal length at "
                        "the file pose; a specimen's are 0.3 to 1.8, and longer than their width",
                        made.rest_stretch));
      continue;
    }
    if (!draw_spindle(line, made)) {
      leave(muscle, "left out: its path ends where it begins at the file pose");
      continue;
    }
    if (const std::string defect = defect_of(line, made, placed); !defect.empty()) {
      leave(muscle, "left out: " + defect);
      continue;
    }
    line.muscle = static_cast<int>(placed.specimen.muscles.size());
    placed.specimen.muscles.push_back(std::move(made));
    placed.specimen.lines.push_back(std::move(line));
  }
  return at_fault;
}

}  // namespace myotact::exchange::opensim
