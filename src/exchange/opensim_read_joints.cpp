#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/at.h"
#include "exchange/opensim_reader.h"

namespace myotact::exchange::opensim {
namespace {

const std::array<Vec3, 3> kUnits = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};

bool is_joint(const std::string& tag) {
  return tag.size() > 5 && tag.ends_with("Joint");
}

Coordinate read_coordinate(const Element& element) {
  element.take();
  Coordinate coordinate;
  coordinate.name = element.name();
  coordinate.default_value = element.number_or("default_value", 0.0);
  element.find("motion_type");
  element.find("clamped");
  if (const auto range = element.find("range")) {
    const std::vector<double> ends = range->numbers();
    if (ends.size() != 2) throw range->error(fmt::format("holds {} numbers; must be two", ends.size()));
    if (!(ends[0] < ends[1])) throw range->error("must rise: the least value, then the greatest");
    coordinate.range = {ends[0], ends[1]};
  }
  if (element.flag_or("locked", false)) coordinate.held = "is locked";
  if (element.flag_or("prescribed", false)) coordinate.held = "follows a prescribed function";
  return coordinate;
}

int coordinate_index(const std::vector<Coordinate>& coordinates, const std::string& name) {
  const auto found =
      std::find_if(coordinates.begin(), coordinates.end(), [&](const Coordinate& c) { return c.name == name; });
  return found == coordinates.end() ? -1 : static_cast<int>(found - coordinates.begin());
}

void read_motion(const Element& element, const Joint& joint, Motion& motion) {
  element.take();
  motion.axis = element.vec3_or("axis", motion.axis);
  if (!(motion.axis.norm() > 1e-6)) throw element.error("its axis has no length");
  motion.axis.normalize();
  const std::string name = element.text_or("coordinates", "");
  const auto function = read_function(element);
  if (!function) {
    element.tell("its function is of a kind that is not read: it is taken as 0");
    return;
  }
  motion.function = *function;
  if (name.empty()) return;
  if (name.find(' ') != std::string::npos) {
    element.tell("depends on several coordinates at once: it is held at their value 0");
    motion.function = {0.0, function->at(0.0), {}, 1.0};
    return;
  }
  motion.coordinate = coordinate_index(joint.coordinates, name);
  if (motion.coordinate < 0) {
    throw element.error(fmt::format("names the coordinate \"{}\", which its joint has not", name.substr(0, 80)));
  }
}

void read_spatial_transform(const Element& element, Joint& joint) {
  for (std::size_t i = 0; i < 3; ++i) {
    joint.rotations[i].axis = joint.translations[i].axis = kUnits[i];
  }
  const auto transform = element.find("SpatialTransform");
  if (!transform) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i + 1);
    if (const auto axis = transform->find_named(("rotation" + number).c_str())) {
      read_motion(*axis, joint, joint.rotations[i]);
    }
    if (const auto axis = transform->find_named(("translation" + number).c_str())) {
      read_motion(*axis, joint, joint.translations[i]);
    }
  }
}

/// The joints whose motion has a name instead of a transform: rotations about these axes by the coordinates in their
/// order, then translations.
struct NamedMotion {
  const char* type;
  std::vector<int> rotations, translations;
};
const std::vector<NamedMotion> kNamedMotions = {{"PinJoint", {2}, {}},        {"UniversalJoint", {0, 1}, {}},
                                                {"BallJoint", {0, 1, 2}, {}}, {"GimbalJoint", {0, 1, 2}, {}},
                                                {"WeldJoint", {}, {}},        {"SliderJoint", {}, {0}},
                                                {"PlanarJoint", {2}, {0, 1}}, {"FreeJoint", {0, 1, 2}, {0, 1, 2}}};

void set_named_motion(const Element& element, Joint& joint) {
  for (std::size_t i = 0; i < 3; ++i) joint.rotations[i].axis = joint.translations[i].axis = kUnits[i];
  const auto known = std::find_if(kNamedMotions.begin(), kNamedMotions.end(),
                                  [&](const NamedMotion& motion) { return motion.type == joint.type; });
  if (known == kNamedMotions.end()) {
    element.tell("a joint of this type is not taken: its bodies are welded where their frames meet");
    return;
  }
  std::size_t next = 0;
  const auto drive = [&](std::array<Motion, 3>& motions, const std::vector<int>& axes) {
    for (std::size_t i = 0; i < axes.size(); ++i, ++next) {
      motions[i].axis = kUnits[at(axes[i])];
      if (next >= joint.coordinates.size()) continue;
      motions[i].coordinate = static_cast<int>(next);
      motions[i].function.slope = 1.0;
    }
  };
  drive(joint.rotations, known->rotations);
  drive(joint.translations, known->translations);
}

void read_frames(const Element& holder, const char* tag, const std::string& owner, Names& names) {
  const auto frames = holder.find(tag);
  if (!frames) return;
  const auto objects = frames->find("objects");
  for (const Element& frame : (objects ? *objects : *frames).children()) {
    if (frame.tag() != "PhysicalOffsetFrame") continue;
    frame.take();
    names.add({frame.name(), owner, frame.at("socket_parent").text(), read_offset(frame, "translation", "orientation"),
               frame});
  }
}

Joint read_joint(const Element& element, Names& names) {
  Joint joint{element.name(), element.tag(), -1, -1, {}, {}, {}, {}, {}, element};
  if (joint.name.empty()) throw element.error("has no name; give it one");
  element.take();
  read_frames(element, "frames", joint.name, names);
  const auto parent = names.resolve(element.at("socket_parent_frame").text(), joint.name, element);
  const auto child = names.resolve(element.at("socket_child_frame").text(), joint.name, element);
  joint.parent = parent.body;
  joint.child = child.body;
  joint.X_PJ = parent.X_BF;
  joint.X_CJ = child.X_BF;
  if (const auto coordinates = element.find("coordinates")) {
    for (const Element& coordinate : coordinates->children()) {
      if (coordinate.tag() == "Coordinate") joint.coordinates.push_back(read_coordinate(coordinate));
    }
  }
  joint.type == "CustomJoint" ? read_spatial_transform(element, joint) : set_named_motion(element, joint);
  return joint;
}

/// A coordinate that others drive does not move by itself.
void hold_driven(const Element& model, RawModel& raw) {
  for (const Element& constraint : model.objects("ConstraintSet")) {
    if (constraint.tag() != "CoordinateCouplerConstraint") continue;
    const auto driven = constraint.find("dependent_coordinate_name");
    if (!driven) continue;
    constraint.tell("couplings are not taken: the driven coordinate is held at its default");
    for (Joint& joint : raw.joints) {
      const int index = coordinate_index(joint.coordinates, driven->text());
      if (index >= 0) joint.coordinates[at(index)].held = "is driven by a coupling";
    }
  }
}

Function function_of(const Element& element, bool& known) {
  element.take();
  Function function;
  const std::string tag = element.tag();
  if (tag == "Constant") {
    function.constant = element.number_or("value", 0.0);
  } else if (tag == "LinearFunction" || tag == "PolynomialFunction") {
    const std::vector<double> c = element.at("coefficients").numbers();
    known = c.size() >= 1 && c.size() <= 2;
    if (c.size() == 2) function.slope = c[0];
    if (!c.empty()) function.constant = c.back();
  } else if (tag == "SimmSpline" || tag == "NaturalCubicSpline" || tag == "GCVSpline" ||
             tag == "PiecewiseLinearFunction") {
    const std::vector<double> x = element.at("x").numbers(), y = element.at("y").numbers();
    if (x.empty() || x.size() != y.size() || !std::is_sorted(x.begin(), x.end())) {
      throw element.error(fmt::format("its {} x and {} y must be as many, and the x rise", x.size(), y.size()));
    }
    for (std::size_t i = 0; i < x.size(); ++i) function.knots.emplace_back(x[i], y[i]);
  } else {
    known = false;
  }
  return function;
}

}  // namespace

double Function::at(double x) const {
  if (knots.empty()) return scale * (constant + slope * x);
  const auto after = std::find_if(knots.begin(), knots.end(), [&](const auto& knot) { return knot.first >= x; });
  if (after == knots.begin()) return scale * knots.front().second;
  if (after == knots.end()) return scale * knots.back().second;
  const auto before = std::prev(after);
  const double share = (x - before->first) / (after->first - before->first);
  return scale * (before->second + share * (after->second - before->second));
}

double Function::travel(const std::pair<double, double>& range) const {
  if (knots.empty()) return std::abs(scale * slope * (range.second - range.first));
  double least = std::min(at(range.first), at(range.second)), most = std::max(at(range.first), at(range.second));
  for (const auto& [x, y] : knots) {
    if (x < range.first || x > range.second) continue;
    least = std::min(least, scale * y);
    most = std::max(most, scale * y);
  }
  return most - least;
}

std::optional<Function> read_function(const Element& holder) {
  for (const Element& child : holder.children()) {
    const std::string tag = child.tag();
    if (tag == "function" || tag == "Constant" || tag.ends_with("Spline") || tag.ends_with("Function")) {
      return as_function(child);
    }
  }
  return std::nullopt;
}

std::optional<Function> as_function(const Element& element) {
  const std::string tag = element.tag();
  if (tag == "function") {  // a wrapper; the depth of a document is bounded
    element.take();
    return read_function(element);
  }
  if (tag == "MultiplierFunction") {
    element.take();
    auto function = read_function(element);
    if (function) function->scale *= element.number_or("scale", 1.0);
    return function;
  }
  bool known = true;
  const Function function = function_of(element, known);
  return known ? std::optional(function) : std::nullopt;
}

void read_joints(const Element& model, Names& names, RawModel& raw) {
  read_frames(model, "components", "", names);
  read_frames(model, "ComponentSet", "", names);
  for (const Element& element : model.objects("JointSet")) {
    if (!is_joint(element.tag())) continue;
    if (raw.joints.size() > kMostBodies) throw element.error(fmt::format("is one of more than {}", kMostBodies));
    Joint joint = read_joint(element, names);
    for (const Joint& other : raw.joints) {
      if (other.child != joint.child) continue;
      throw element.error(
          fmt::format("carries the body {}, which already hangs on the joint {}: a ring of bodies; cut "
                      "it by deleting one of the two",
                      raw.bodies[at(joint.child)].name, other.name));
    }
    raw.joints.push_back(joint);
  }
  hold_driven(model, raw);
}

void read_springs(const Element& model, RawModel& raw) {
  for (const Element& element : model.objects("ForceSet")) {
    if (element.tag() != "SpringGeneralizedForce") continue;
    element.take();
    element.find("appliesForce");
    raw.springs.push_back({element.at("coordinate").text(), element.number_or("stiffness", 0.0),
                           element.number_or("rest_length", 0.0), element.number_or("viscosity", 0.0), element});
  }
}

}  // namespace myotact::exchange::opensim
