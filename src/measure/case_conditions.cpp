#include "measure/case_conditions.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "geometry/tet_topology.h"
#include "measure/case_sets.h"

namespace myotact::measure {

namespace {

/// Everything the conditions of a case are added to.
class ConditionReader {
 public:
  ConditionReader(const NodeSets& sets, SolveCase& out) : sets_(sets), out_(out) {
    out_.loads.nodal_force_N = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * mesh().nodes_m.size()));
    held_.assign(3 * mesh().nodes_m.size(), kFree);
  }

  void read(const JsonValue& value);
  void finish();

 private:
  static constexpr int kFree = -1;

  const geometry::TetMesh& mesh() const { return out_.mesh.mesh; }
  void hold(const JsonValue& place, int node, int component, double displacement_m);
  void fix(const JsonValue& place, const NodeSet& set);
  void symmetry(const JsonValue& place, const NodeSet& set);
  void displace(const JsonValue& value, const NodeSet& set);
  void traction(const JsonValue& value, const NodeSet& set);
  void pressure(const JsonValue& value, const NodeSet& set);
  void gravity(const JsonValue& value);
  void read_ramp(const JsonValue& value, const std::string& kind);
  std::vector<geometry::BoundaryTriangle> triangles_in(const JsonValue& place, const NodeSet& set);

  const NodeSets& sets_;
  SolveCase& out_;
  std::vector<int> held_;  // index into loads.held for each component of each node
  std::optional<std::vector<geometry::BoundaryTriangle>> boundary_;
};

/// Loads beyond these are slips of units or would overflow the sums.
constexpr double kLargestStress_Pa = 1e15;
constexpr double kLargestLength_m = 1e6;
constexpr double kLargestGravity_m_s2 = 1e9;

Vec3 bounded_vector(const JsonValue& value, double largest) {
  const auto parts = value.elements(3);
  return {parts[0].number_between(-largest, largest), parts[1].number_between(-largest, largest),
          parts[2].number_between(-largest, largest)};
}

void ConditionReader::hold(const JsonValue& place, int node, int component, double displacement_m) {
  int& index = held_[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(component)];
  if (index == kFree) {
    index = static_cast<int>(out_.loads.held.size());
    out_.loads.held.push_back({node, component, displacement_m});
    return;
  }
  const double other_m = out_.loads.held[static_cast<std::size_t>(index)].displacement_m;
  if (other_m == displacement_m) return;
  throw place.error(
      fmt::format("holds component {} of node {} at {} m, but another condition at {}; leave one of them "
                  "free with null",
                  component, node, to_text(displacement_m), to_text(other_m)));
}

void ConditionReader::fix(const JsonValue& place, const NodeSet& set) {
  for (const int node : set.nodes) {
    for (int component = 0; component < 3; ++component) hold(place, node, component, 0.0);
  }
}

void ConditionReader::symmetry(const JsonValue& place, const NodeSet& set) {
  if (set.plane_axis < 0) throw place.error("symmetry needs a set that is a plane; use \"displace\" with null instead");
  for (const int node : set.nodes) hold(place, node, set.plane_axis, 0.0);
}

void ConditionReader::displace(const JsonValue& value, const NodeSet& set) {
  const auto parts = value.elements(3);
  for (int component = 0; component < 3; ++component) {
    const JsonValue& part = parts[static_cast<std::size_t>(component)];
    if (part.raw().is_null()) continue;
    const double displacement_m = part.number_between(-kLargestLength_m, kLargestLength_m);
    for (const int node : set.nodes) hold(part, node, component, displacement_m);
  }
}

std::vector<geometry::BoundaryTriangle> ConditionReader::triangles_in(const JsonValue& place, const NodeSet& set) {
  if (!boundary_) boundary_ = geometry::boundary_triangles(mesh());
  std::vector<char> member(mesh().nodes_m.size(), 0);
  for (const int node : set.nodes) member[static_cast<std::size_t>(node)] = 1;
  std::vector<geometry::BoundaryTriangle> inside;
  for (const auto& triangle : *boundary_) {
    if (std::all_of(triangle.corners.begin(), triangle.corners.end(),
                    [&](int node) { return member[static_cast<std::size_t>(node)] != 0; })) {
      inside.push_back(triangle);
    }
  }
  if (inside.empty()) {
    throw place.error(fmt::format("no triangle of the surface has all three corners among the set's {} nodes; widen it",
                                  set.nodes.size()));
  }
  return inside;
}

/// Consistent loads of a constant traction: a third of the triangle's to each corner of a linear one, to each mid-side
/// (and nothing to the corners) of a quadratic one with straight sides.
void ConditionReader::traction(const JsonValue& value, const NodeSet& set) {
  const Vec3 traction_Pa = bounded_vector(value, kLargestStress_Pa);
  for (const auto& triangle : triangles_in(value, set)) {
    const auto corner = [&](std::size_t k) { return mesh().nodes_m[static_cast<std::size_t>(triangle.corners[k])]; };
    const double area_m2 = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    for (const int node : mesh().quadratic() ? triangle.midsides : triangle.corners) {
      out_.loads.nodal_force_N.segment<3>(3 * node) += area_m2 / 3.0 * traction_Pa;
    }
  }
}

void ConditionReader::pressure(const JsonValue& value, const NodeSet& set) {
  const double pressure_Pa = value.number_between(-kLargestStress_Pa, kLargestStress_Pa);
  for (const auto& triangle : triangles_in(value, set)) {
    const auto& [a, b, c] = triangle.corners;
    const auto& [ab, bc, ca] = triangle.midsides;
    out_.loads.pressure.push_back({{a, b, c, ab, bc, ca}, mesh().quadratic(), pressure_Pa});
  }
}

void ConditionReader::gravity(const JsonValue& value) {
  out_.loads.gravity_m_s2 += bounded_vector(value, kLargestGravity_m_s2);
}

/// Static: the least number of equal steps in which everything grows. Dynamic: the time over which the activation
/// grows.
void ConditionReader::read_ramp(const JsonValue& value, const std::string& kind) {
  constexpr int kMostSteps = 10'000;
  if (out_.dynamics == Dynamics::Static) {
    out_.load_steps = std::max(out_.load_steps, value.integer_between(1, kMostSteps));
    return;
  }
  if (kind != "activation") {
    throw value.error(
        fmt::format("in motion only \"activation\" grows with time; a {} acts from the start: leave "
                    "\"ramp\" out",
                    kind));
  }
  constexpr double kLongest_s = 1e6;
  out_.activation_ramp_s = value.number_between(0.0, kLongest_s);
}

void ConditionReader::read(const JsonValue& value) {
  JsonObject fields(value);
  const JsonValue kind_value = fields.at("kind");
  const std::string kind =
      kind_value.one_of({"fix", "symmetry", "displace", "traction", "pressure", "gravity", "activation"});
  const bool of_body = kind == "gravity" || kind == "activation";
  const auto name = of_body ? fields.find("set") : fields.at("set");
  const NodeSet& set = name ? require_set(*name, sets_) : sets_.at("all");
  if (of_body && name && set.nodes.size() != mesh().nodes_m.size()) {
    throw name->error(fmt::format("{} acts on the whole body; leave \"set\" out", kind));
  }
  if (const auto ramp = fields.find("ramp")) read_ramp(*ramp, kind);
  if (kind == "fix") fix(value, set);
  if (kind == "symmetry") symmetry(value, set);
  if (kind == "displace") displace(fields.at("value"), set);
  if (kind == "traction") traction(fields.at("value"), set);
  if (kind == "pressure") pressure(fields.at("value"), set);
  if (kind == "gravity") gravity(fields.at("value"));
  if (kind == "activation") out_.loads.activation = fields.at("value").number_between(0.0, 1.0);
  fields.finish();
}

void ConditionReader::finish() {
  std::sort(out_.loads.held.begin(), out_.loads.held.end(), [](const auto& a, const auto& b) {
    return a.node != b.node ? a.node < b.node : a.component < b.component;
  });
}

}  // namespace

void read_conditions(const JsonValue& value, const NodeSets& sets, SolveCase& out) {
  ConditionReader reader(sets, out);
  for (const JsonValue& entry : value.elements()) reader.read(entry);
  reader.finish();
}

}  // namespace myotact::measure
