#include "measure/case_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::measure {

namespace {

/// A plane's reach on either side where the file gives none, over the diagonal of the mesh: mesh files keep six digits
/// or more.
constexpr double kPlaneReach = 1e-6;

const Vec3& position_of(const CaseMesh& mesh, std::size_t node) {
  return mesh.mesh.nodes_m[node];
}

double diagonal_m(const CaseMesh& mesh) {
  Vec3 lowest = position_of(mesh, 0);
  Vec3 highest = lowest;
  for (const Vec3& node : mesh.mesh.nodes_m) {
    lowest = lowest.cwiseMin(node);
    highest = highest.cwiseMax(node);
  }
  return (highest - lowest).norm();
}

/// Nodes whose distance from a shape is at most `reach_m`. Throws when there are none, stating how far the nearest is.
template <class Distance>
std::vector<int> nodes_within(const JsonValue& value, const CaseMesh& mesh, double reach_m, Distance&& distance_m) {
  std::vector<int> nodes;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < mesh.mesh.nodes_m.size(); ++n) {
    const double here_m = distance_m(position_of(mesh, n));
    nearest_m = std::min(nearest_m, here_m);
    if (here_m <= reach_m) nodes.push_back(static_cast<int>(n));
  }
  if (nodes.empty()) {
    throw value.error(
        fmt::format("the set is empty: the nearest node is {} m away, and at most {} is allowed; move or "
                    "widen it",
                    to_text(nearest_m), to_text(reach_m)));
  }
  return nodes;
}

NodeSet read_plane(const JsonValue& value, const CaseMesh& mesh) {
  JsonObject plane(value);
  static const std::vector<std::string> kAxes = {"x", "y", "z"};
  const std::string axis = plane.at("axis").one_of(kAxes);
  const double place_m = plane.at("value").number();
  const auto tolerance = plane.find("tolerance");
  const double reach_m = tolerance ? tolerance->number_between(0.0, 1e6) : kPlaneReach * diagonal_m(mesh);
  plane.finish();
  NodeSet set;
  set.plane_axis = static_cast<int>(std::find(kAxes.begin(), kAxes.end(), axis) - kAxes.begin());
  set.nodes = nodes_within(value, mesh, reach_m, [&](const Vec3& x) { return std::abs(x[set.plane_axis] - place_m); });
  return set;
}

NodeSet read_box(const JsonValue& value, const CaseMesh& mesh) {
  const auto parts = value.elements(6);
  Vec3 lowest;
  Vec3 highest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    lowest[k] = parts[axis].number();
    highest[k] = parts[axis + 3].number();
    if (lowest[k] > highest[k]) {
      throw parts[axis].error(
          fmt::format("is {}, beyond the other end {}; a box is [x0, y0, z0, x1, y1, z1], lower "
                      "corner first",
                      to_text(lowest[k]), to_text(highest[k])));
    }
  }
  const auto outside_m = [&](const Vec3& x) { return (x - x.cwiseMax(lowest).cwiseMin(highest)).norm(); };
  return {nodes_within(value, mesh, 0.0, outside_m), -1};
}

/// Mid-sides that the element added lie in a set with both their corners.
void add_new_midsides(const CaseMesh& mesh, std::vector<char>& member) {
  const auto of_file = std::count_if(mesh.node_of_file.begin(), mesh.node_of_file.end(), [](int n) { return n >= 0; });
  for (std::size_t tet = 0; tet < mesh.mesh.midsides.size(); ++tet) {
    for (std::size_t e = 0; e < geometry::kTetEdges.size(); ++e) {
      const int node = mesh.mesh.midsides[tet][e];
      if (node < of_file) continue;
      const auto end = [&](std::size_t k) {
        const auto corner = static_cast<std::size_t>(geometry::kTetEdges[e][k]);
        return member[static_cast<std::size_t>(mesh.mesh.corners[tet][corner])];
      };
      if (end(0) != 0 && end(1) != 0) member[static_cast<std::size_t>(node)] = 1;
    }
  }
}

NodeSet members(const std::vector<char>& member) {
  NodeSet set;
  for (std::size_t n = 0; n < member.size(); ++n) {
    if (member[n] != 0) set.nodes.push_back(static_cast<int>(n));
  }
  return set;
}

NodeSet read_nodes(const JsonValue& value, const CaseMesh& mesh) {
  std::vector<char> member(mesh.mesh.nodes_m.size(), 0);
  const auto list = value.elements();
  if (list.empty()) throw value.error("the set is empty; name at least one node");
  for (const JsonValue& entry : list) {
    const int of_file = entry.integer_between(0, static_cast<int>(mesh.node_of_file.size()) - 1);
    const int node = mesh.node_of_file[static_cast<std::size_t>(of_file)];
    if (node < 0) {
      throw entry.error(
          fmt::format("node {} is a corner of no tet, and mid-sides count for T10 only; leave it out", of_file));
    }
    member[static_cast<std::size_t>(node)] = 1;
  }
  add_new_midsides(mesh, member);
  return members(member);
}

NodeSet read_attachment(const JsonValue& value, const CaseMesh& mesh) {
  const int body = value.integer_between(0, 1'000'000);
  if (mesh.attachments.empty()) {
    throw value.error(fmt::format("{} has no point data \"attachment\"; use a plane, a box or nodes", mesh.file));
  }
  std::vector<char> member;
  for (const int attachment : mesh.attachments) member.push_back(attachment == body ? 1 : 0);
  NodeSet set = members(member);
  if (set.nodes.empty()) {
    const int last = *std::max_element(mesh.attachments.begin(), mesh.attachments.end());
    throw value.error(
        fmt::format("the set is empty: no node has the attachment {}; the last one in use is {}", body, last));
  }
  return set;
}

NodeSet read_set(const JsonValue& value, const CaseMesh& mesh) {
  using Reader = NodeSet (*)(const JsonValue&, const CaseMesh&);
  static const std::vector<std::pair<const char*, Reader>> kKinds = {
      {"plane", read_plane}, {"box", read_box}, {"nodes", read_nodes}, {"attachment", read_attachment}};
  JsonObject fields(value);
  std::optional<NodeSet> set;
  for (const auto& [kind, reader] : kKinds) {
    const auto found = fields.find(kind);
    if (!found) continue;
    if (set) throw value.error("must hold one of plane, box, nodes and attachment, not several");
    set = reader(*found, mesh);
  }
  fields.finish();
  if (!set) throw value.error("must hold one of plane, box, nodes and attachment");
  return *set;
}

}  // namespace

NodeSets read_sets(const std::optional<JsonValue>& value, const CaseMesh& mesh) {
  NodeSets sets;
  sets["all"].nodes.resize(mesh.mesh.nodes_m.size());
  std::iota(sets["all"].nodes.begin(), sets["all"].nodes.end(), 0);
  if (!value) return sets;
  for (const auto& [name, entry] : JsonObject(*value).entries()) sets[name] = read_set(entry, mesh);
  return sets;
}

NodeSet set_of_file_nodes(const std::vector<int>& of_file, const CaseMesh& mesh) {
  std::vector<char> member(mesh.mesh.nodes_m.size(), 0);
  for (const int number : of_file) {
    const int node = mesh.node_of_file[static_cast<std::size_t>(number)];
    if (node >= 0) member[static_cast<std::size_t>(node)] = 1;
  }
  add_new_midsides(mesh, member);
  return members(member);
}

const NodeSet& require_set(const JsonValue& name, const NodeSets& sets) {
  std::vector<std::string> names;
  for (const auto& [known, set] : sets) names.push_back(known);
  return sets.at(name.one_of(names));
}

std::vector<int> tets_of(const NodeSet& set, const geometry::TetMesh& mesh) {
  std::vector<char> member(mesh.nodes_m.size(), 0);
  for (const int node : set.nodes) member[static_cast<std::size_t>(node)] = 1;
  std::vector<int> whole;
  std::vector<int> touched;
  for (std::size_t tet = 0; tet < mesh.corners.size(); ++tet) {
    const auto& corners = mesh.corners[tet];
    const auto inside = std::count_if(corners.begin(), corners.end(),
                                      [&](int node) { return member[static_cast<std::size_t>(node)] != 0; });
    if (inside == 4) whole.push_back(static_cast<int>(tet));
    if (inside > 0) touched.push_back(static_cast<int>(tet));
  }
  return whole.empty() ? touched : whole;
}

}  // namespace myotact::measure
