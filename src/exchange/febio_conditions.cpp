#include "exchange/febio_conditions.h"

#include <algorithm>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/at.h"
#include "core/text.h"
#include "geometry/tet_topology.h"
#include "measure/case_sets.h"

namespace myotact::exchange {

namespace {

using measure::NodeSet;

class FebioConditionReader {
 public:
  FebioConditionReader(const FebioMesh& mesh, FebioFile& file, measure::SolveCase& out)
      : mesh_(mesh), file_(file), out_(out) {
    const auto nodes = static_cast<Eigen::Index>(out.mesh.mesh.nodes_m.size());
    out.loads.nodal_force_N = Eigen::VectorXd::Zero(3 * nodes);
  }

  void read(const FebioSections& sections) {
    for (const pugi::xml_node& boundary : sections.boundary) {
      for (const pugi::xml_node& condition : boundary.children()) read_condition(condition);
    }
    for (const pugi::xml_node& loads : sections.loads) {
      for (const pugi::xml_node& load : loads.children()) read_load(load);
    }
    for (const auto& [place, displacement_m] : held_) {
      out_.loads.held.push_back({place.first, place.second, displacement_m});
    }
  }

 private:
  const std::vector<int>& node_list(const pugi::xml_node& node) {
    const std::string name = file_.attribute(node, "node_set");
    constexpr std::string_view kOfSurface = "@surface:";
    if (name.starts_with(kOfSurface)) return nodes_of_surface(node, name.substr(kOfSurface.size()));
    const auto found = mesh_.node_sets.find(name);
    if (found == mesh_.node_sets.end()) {
      throw file_.error(node, fmt::format("names the node set \"{}\", which <Mesh> does not have", name));
    }
    return found->second;
  }

  const std::vector<int>& nodes_of_surface(const pugi::xml_node& node, const std::string& name) {
    std::vector<int>& nodes = surface_nodes_[name];
    if (nodes.empty()) {
      for (const auto& triangle : surface(node, name)) nodes.insert(nodes.end(), triangle.begin(), triangle.end());
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
    return nodes;
  }

  const std::vector<std::array<int, 3>>& surface(const pugi::xml_node& node, const std::string& name) const {
    const auto found = mesh_.surfaces.find(name);
    if (found == mesh_.surfaces.end()) {
      throw file_.error(node, fmt::format("names the surface \"{}\", which <Mesh> does not have", name));
    }
    return found->second;
  }

  /// In motion all loads act from the start.
  double scale_of(const pugi::xml_node& value) {
    if (out_.dynamics != measure::Dynamics::Static && file_.rise_s(value) > 0.0) {
      file_.cannot(value, "that grows in motion (only activations do; leave \"lc\" out)");
    }
    return file_.scale_of(value);
  }

  void read_condition(const pugi::xml_node& node) {
    if (node.type() != pugi::node_element) return;
    const std::string type = node.attribute("type").value();
    if (type == "zero displacement") return fix(node);
    if (type == "prescribed displacement") return displace(node);
    file_.cannot(node, fmt::format("of the type \"{}\"", type));
  }

  void add_outputs(const pugi::xml_node& node, const NodeSet& set) {
    const std::string name =
        node.attribute("name") ? node.attribute("name").value() : node.attribute("node_set").value();
    out_.outputs.push_back(
        {name + ".displacement.mean", measure::Quantity::Displacement, measure::Reduction::Mean, set.nodes, {}});
    out_.outputs.push_back(
        {name + ".reaction.sum", measure::Quantity::Reaction, measure::Reduction::Sum, set.nodes, {}});
  }

  void fix(const pugi::xml_node& node) {
    const NodeSet set = measure::set_of_file_nodes(node_list(node), out_.mesh);
    constexpr std::array<const char*, 3> kDofs = {"x_dof", "y_dof", "z_dof"};
    for (int k = 0; k < 3; ++k) {
      if (file_.value(node, kDofs[at(k)], 0.0) == 0.0) continue;
      for (const int n : set.nodes) hold(node, n, k, 0.0);
    }
    add_outputs(node, set);
  }

  void hold(const pugi::xml_node& node, int n, int component, double displacement_m) {
    const auto [place, is_new] = held_.emplace(std::pair(n, component), displacement_m);
    if (is_new || place->second == displacement_m) return;
    throw file_.error(node, fmt::format("moves a node by {} in a direction in which another condition moves it by {}",
                                        to_text(displacement_m), to_text(place->second)));
  }

  void displace(const pugi::xml_node& node) {
    if (file_.value(node, "relative", 0.0) != 0.0) return file_.cannot(node, "relative to where it is");
    const std::string dof = file_.child(node, "dof").child_value();
    const int component = dof == "x" ? 0 : dof == "y" ? 1 : dof == "z" ? 2 : -1;
    if (component < 0) return file_.cannot(node, fmt::format("of the direction \"{}\"", dof));
    const std::vector<int>& listed = node_list(node);
    const pugi::xml_node value = file_.child(node, "value");
    const double scale = scale_of(value);
    std::map<int, double> moved_m;  // by node of the case
    const std::vector<double> values = values_of(node, value, 1, listed.size());
    for (std::size_t k = 0; k < listed.size(); ++k) {
      const int n = out_.mesh.node_of_file[at(listed[k])];
      if (n >= 0) moved_m[n] = scale * values[k];
    }
    const NodeSet set = measure::set_of_file_nodes(listed, out_.mesh);
    for (const int n : set.nodes) {
      const auto found = moved_m.find(n);
      hold(node, n, component, found != moved_m.end() ? found->second : between(n, moved_m));
    }
    add_outputs(node, set);
  }

  /// Of a mid-side that was added, whose corners both are among the moved.
  double between(int midside, const std::map<int, double>& moved_m) {
    if (ends_.empty()) find_ends();
    const auto& [a, b] = ends_.at(midside);
    return 0.5 * (moved_m.at(a) + moved_m.at(b));
  }

  void find_ends() {
    const geometry::TetMesh& mesh = out_.mesh.mesh;
    for (std::size_t t = 0; t < mesh.midsides.size(); ++t) {
      const std::array<int, 4>& corners = mesh.corners[t];
      for (std::size_t e = 0; e < geometry::kTetEdges.size(); ++e) {
        const auto& [a, b] = geometry::kTetEdges[e];
        ends_[mesh.midsides[t][e]] = {corners[at(a)], corners[at(b)]};
      }
    }
  }

  /// `components` numbers for each of a set's nodes: the same for all, or out of <MeshData>.
  std::vector<double> values_of(const pugi::xml_node& node, const pugi::xml_node& value, std::size_t components,
                                std::size_t count) const {
    std::vector<double> out;
    const std::string type = value.attribute("type").value();
    if (type.empty() || type == "const") {
      const std::vector<double> same = file_.numbers(value, components);
      for (std::size_t k = 0; k < count; ++k) out.insert(out.end(), same.begin(), same.end());
      return out;
    }
    if (type != "map") throw file_.error(value, fmt::format("is of the type \"{}\"; const and map are read", type));
    const std::string name = value.child_value();
    for (const pugi::xml_node& data : file_.root().child("MeshData").children("NodeData")) {
      if (name != data.attribute("name").value()) continue;
      if (std::string(data.attribute("node_set").value()) != node.attribute("node_set").value()) {
        throw file_.error(data, "is of another node set than the condition that uses it");
      }
      return table_of(data, components, count);
    }
    throw file_.error(value, fmt::format("names the data \"{}\", which <MeshData> does not have", name));
  }

  std::vector<double> table_of(const pugi::xml_node& data, std::size_t components, std::size_t count) const {
    std::vector<double> out(components * count, 0.0);  // FEBio takes 0 where none is given
    for (const pugi::xml_node& entry : data.children("node")) {
      const int lid = entry.attribute("lid").as_int(0);
      if (lid < 1 || at(lid) > count) {
        throw file_.error(entry, fmt::format("has the lid {}; the set has 1 to {}", lid, count));
      }
      const std::vector<double> numbers = file_.numbers(entry, components);
      std::copy(numbers.begin(), numbers.end(), out.begin() + static_cast<std::ptrdiff_t>(components * (at(lid) - 1)));
    }
    return out;
  }

  void read_load(const pugi::xml_node& node) {
    if (node.type() != pugi::node_element) return;
    const std::string name = node.name(), type = node.attribute("type").value();
    if (name == "nodal_load" && type == "nodal_force") return pull(node);
    if (name == "surface_load" && type == "pressure") return press(node);
    if (name == "surface_load" && type == "traction") return drag(node);
    if (name == "body_load" && type == "body force") {
      const pugi::xml_node force = file_.child(node, "force");
      if (std::string(force.attribute("type").value()) == "math") return file_.cannot(force, "of the type \"math\"");
      out_.loads.gravity_m_s2 -= scale_of(force) * file_.vector(force);  // FEBio subtracts body forces
      return;
    }
    if (name == "body_load" && type == "const") {
      constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
      for (int k = 0; k < 3; ++k) out_.loads.gravity_m_s2[k] -= file_.value(node, kNames[at(k)], 0.0);
      return;
    }
    file_.cannot(node, fmt::format("of the type \"{}\"", type));
  }

  void pull(const pugi::xml_node& node) {
    if (file_.value(node, "relative", 0.0) != 0.0) return file_.cannot(node, "relative to what is there");
    const std::vector<int>& listed = node_list(node);
    const pugi::xml_node value = file_.child(node, "value");
    const double scale = scale_of(value);
    const std::vector<double> forces = values_of(node, value, 3, listed.size());
    for (std::size_t k = 0; k < listed.size(); ++k) {
      const int n = out_.mesh.node_of_file[at(listed[k])];
      if (n < 0) throw file_.error(node, "pulls at a node that no element has");
      out_.loads.nodal_force_N.segment<3>(3 * n) += scale * Vec3(forces[3 * k], forces[3 * k + 1], forces[3 * k + 2]);
    }
  }

  std::vector<geometry::BoundaryTriangle> boundary_of(const pugi::xml_node& node) {
    if (boundary_.empty()) {
      for (const auto& triangle : geometry::boundary_triangles(out_.mesh.mesh)) {
        boundary_[sorted(triangle.corners)] = triangle;
      }
    }
    std::vector<geometry::BoundaryTriangle> out;
    for (std::array<int, 3> corners : surface(node, file_.attribute(node, "surface"))) {
      for (int& corner : corners) corner = out_.mesh.node_of_file[at(corner)];
      const auto found = boundary_.find(sorted(corners));
      if (found == boundary_.end()) {
        throw file_.error(node, "acts on a face that is not on the surface of the body");
      }
      out.push_back(found->second);
    }
    return out;
  }

  static std::array<int, 3> sorted(std::array<int, 3> corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
  }

  void press(const pugi::xml_node& node) {
    if (file_.value(node, "linear", 0.0) != 0.0) return file_.cannot(node, "that does not follow the surface");
    const pugi::xml_node value = file_.child(node, "pressure");
    const double pressure_Pa = scale_of(value) * file_.number(value);
    for (const auto& triangle : boundary_of(node)) {
      const auto& [a, b, c] = triangle.corners;
      const auto& [ab, bc, ca] = triangle.midsides;
      out_.loads.pressure.push_back({{a, b, c, ab, bc, ca}, out_.mesh.mesh.quadratic(), pressure_Pa});
    }
  }

  void drag(const pugi::xml_node& node) {
    if (file_.value(node, "linear", 1.0) == 0.0) {
      return file_.cannot(node, "over the area as it is then (one over the area at rest, linear 1, is read)");
    }
    const pugi::xml_node traction = file_.child(node, "traction"), scale = node.child("scale");
    Vec3 traction_Pa = scale_of(traction) * file_.vector(traction);
    if (scale) traction_Pa *= scale_of(scale) * file_.number(scale);
    const geometry::TetMesh& mesh = out_.mesh.mesh;
    for (const auto& triangle : boundary_of(node)) {
      const auto corner = [&](std::size_t k) -> const Vec3& { return mesh.nodes_m[at(triangle.corners[k])]; };
      const double area_m2 = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
      for (const int n : mesh.quadratic() ? triangle.midsides : triangle.corners) {
        out_.loads.nodal_force_N.segment<3>(3 * n) += area_m2 / 3.0 * traction_Pa;
      }
    }
  }

  const FebioMesh& mesh_;
  FebioFile& file_;
  measure::SolveCase& out_;
  std::map<std::pair<int, int>, double> held_;  // node and component of the case
  std::map<std::string, std::vector<int>> surface_nodes_;
  std::map<int, std::pair<int, int>> ends_;
  std::map<std::array<int, 3>, geometry::BoundaryTriangle> boundary_;
};

}  // namespace

void read_febio_conditions(const FebioSections& sections, const FebioMesh& mesh, FebioFile& file,
                           measure::SolveCase& out) {
  FebioConditionReader(mesh, file, out).read(sections);
}

}  // namespace myotact::exchange
