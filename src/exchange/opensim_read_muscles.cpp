#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/at.h"
#include "exchange/opensim_reader.h"

namespace myotact::exchange::opensim {
namespace {

bool is_taken_type(const std::string& tag) {
  return tag == "Millard2012EquilibriumMuscle" || tag == "Thelen2003Muscle" || tag == "DeGrooteFregly2016Muscle";
}

/// Time constants that OpenSim takes where a file names none.
struct Times {
  double rise_s, fall_s;
};
Times usual_times(const std::string& type) {
  if (type == "Millard2012EquilibriumMuscle") return {0.010, 0.040};
  if (type == "Thelen2003Muscle") return {0.015, 0.050};
  return {0.015, 0.060};
}

void read_moving(const Element& element, PathPoint& point) {
  static constexpr const char* kAxes[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string axis = kAxes[i];
    std::string coordinate = element.text_or(("socket_" + axis + "_coordinate").c_str(), "");
    if (coordinate.empty()) coordinate = element.text_or((axis + "_coordinate").c_str(), "");
    // OpenSim writes the function itself, under this name, or in an element of that name.
    const auto named = element.find_named((axis + "_location").c_str());
    const auto holder = element.find((axis + "_location").c_str());
    if (!named && !holder) continue;
    const auto function = named ? as_function(*named) : read_function(*holder);
    if (!function) continue;
    point.moving[i] = PathPoint::Moving{last_part(coordinate), *function};
  }
  element.tell("a point that moves on its body is fixed where it is at the file pose");
}

PathPoint read_point(const Element& element, const Names& names) {
  element.take();
  const OnBody place = names.resolve(element.at("socket_parent_frame").text(), "", element);
  PathPoint point{place.body, place.X_BF, element.vec3_or("location", Vec3::Zero()), {}, std::nullopt, element};
  if (element.tag() == "MovingPathPoint") read_moving(element, point);
  if (element.tag() == "ConditionalPathPoint") {
    PathPoint::Condition condition;
    condition.coordinate = last_part(element.text_or("socket_coordinate", element.text_or("coordinate", "")));
    if (const auto range = element.find("range")) {
      const std::vector<double> ends = range->numbers();
      if (ends.size() != 2) throw range->error(fmt::format("holds {} numbers; must be two", ends.size()));
      condition.range = {ends[0], ends[1]};
    }
    point.condition = condition;
  }
  return point;
}

PathWrap read_path_wrap(const Element& element, const Names& names) {
  element.take();
  element.find("method");
  const std::string object = element.text_or("wrap_object", element.text_or("socket_wrap_object", ""));
  PathWrap wrap{names.wrap_object(object, element), 0, -1, element};
  if (const auto range = element.find("range")) {
    const std::vector<double> ends = range->numbers();
    constexpr double kMost = 1e6;
    const auto is_point = [](double end) { return end == std::floor(end) && end >= -1.0 && end <= kMost; };
    if (ends.size() != 2 || !is_point(ends[0]) || !is_point(ends[1])) {
      throw range->error("must be two numbers of points of the path, or -1 -1 for all of it");
    }
    if (ends[0] > 0.0) wrap.first = static_cast<int>(ends[0]) - 1;
    if (ends[1] > 0.0) wrap.last = static_cast<int>(ends[1]) - 1;
  }
  return wrap;
}

void read_path(const Element& element, const Names& names, Muscle& muscle) {
  auto path = element.find("GeometryPath");
  if (!path) {  // since OpenSim 4.5
    if (const auto holder = element.find("path")) path = holder->find("GeometryPath");
  }
  if (!path) {
    element.tell("has no GeometryPath, the one kind of path that is read: it is left out");
    return;
  }
  for (const Element& point : path->objects("PathPointSet")) {
    if (!point.tag().ends_with("PathPoint")) continue;
    if (muscle.points.size() >= kMostPoints) throw point.error(fmt::format("is one of more than {}", kMostPoints));
    muscle.points.push_back(read_point(point, names));
  }
  for (const Element& wrap : path->objects("PathWrapSet")) {
    if (wrap.tag() != "PathWrap") continue;
    if (muscle.wraps.size() >= kMostPoints) throw wrap.error(fmt::format("is one of more than {}", kMostPoints));
    muscle.wraps.push_back(read_path_wrap(wrap, names));
  }
}

}  // namespace

void read_muscles(const Element& model, const Names& names, RawModel& raw) {
  for (const Element& element : model.objects("ForceSet")) {
    if (!is_taken_type(element.tag())) continue;
    if (raw.muscles.size() >= kMostMuscles) throw element.error(fmt::format("is one of more than {}", kMostMuscles));
    element.take();
    Muscle muscle{element.name(), element.tag(), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, {}, {}, element};
    if (muscle.name.empty()) throw element.error("has no name; give it one");
    muscle.peak_force_N = element.number("max_isometric_force");
    muscle.optimal_fibre_m = element.number("optimal_fiber_length");
    muscle.tendon_slack_m = element.number("tendon_slack_length");
    muscle.pennation_rad = element.number_or("pennation_angle_at_optimal", 0.0);
    const Times usual = usual_times(muscle.type);
    muscle.activation_tau_s = element.number_or("activation_time_constant", usual.rise_s);
    muscle.deactivation_tau_s = element.number_or("deactivation_time_constant", usual.fall_s);
    if (!element.flag_or("appliesForce", true)) element.tell("applies no force in the model; here it does");
    constexpr double kStretchingTendon_m = 1e-4;  // a shorter one is rigid in any case
    if (element.flag_or("ignore_tendon_compliance", false) && muscle.tendon_slack_m >= kStretchingTendon_m) {
      element.tell("its tendon is rigid in the model; here all are elastic, or rigid by the scene's tissue.tendon");
    }
    read_path(element, names, muscle);
    raw.muscles.push_back(muscle);
  }
}

}  // namespace myotact::exchange::opensim
