#include "exchange/febio_mesh.h"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include "core/at.h"

namespace myotact::exchange {

namespace {

/// Faces of a hexahedron, counter-clockwise seen from outside.
constexpr std::array<std::array<std::size_t, 4>, 6> kHexFaces = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// A quadrilateral as two triangles, by the diagonal from its lowest node: the same for both its neighbours.
std::array<std::array<int, 3>, 2> halves(std::array<int, 4> quad) {
  std::rotate(quad.begin(), std::min_element(quad.begin(), quad.end()), quad.end());
  return {{{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}}};
}

class FebioMeshReader {
 public:
  explicit FebioMeshReader(FebioFile& file) : file_(file), node_(file.child(file.root(), "Mesh")) {}

  FebioMesh read() {
    for (const pugi::xml_node& nodes : node_.children("Nodes")) read_nodes(nodes);
    if (out_.mesh.nodes_m.empty()) throw file_.error(node_, "has no <Nodes> with at least one node");
    out_.nodes_of_file = out_.mesh.nodes_m.size();
    for (const pugi::xml_node& child : node_.children()) {
      const std::string name = child.name();
      if (name == "Elements") read_elements(child);
      if (name == "NodeSet") out_.node_sets[file_.attribute(child, "name")] = listed_nodes(child);
    }
    for (const pugi::xml_node& child : node_.children()) read_rest(child);
    if (out_.mesh.corners.empty()) {
      file_.refuse_all();
      throw file_.error(node_, "has no element; at least one tet4, tet10 or hex8 is needed");
    }
    return std::move(out_);
  }

 private:
  void read_nodes(const pugi::xml_node& nodes) {
    std::vector<int> all;
    for (const pugi::xml_node& node : nodes.children("node")) {
      const int id = id_of(node);
      if (!place_.emplace(id, static_cast<int>(out_.mesh.nodes_m.size())).second) {
        throw file_.error(node, fmt::format("has the id {} again; ids must differ", id));
      }
      all.push_back(static_cast<int>(out_.mesh.nodes_m.size()));
      out_.mesh.nodes_m.push_back(file_.vector(node));
    }
    if (nodes.attribute("name")) out_.node_sets[nodes.attribute("name").value()] = all;
  }

  int id_of(const pugi::xml_node& node) const {
    const int id = node.attribute("id").as_int(0);
    if (id < 1) throw file_.error(node, "has no id, a whole number from 1 on");
    return id;
  }

  int place_of(const pugi::xml_node& node, int id) const {
    const auto found = place_.find(id);
    if (found == place_.end()) throw file_.error(node, fmt::format("names the node {}, which there is not", id));
    return found->second;
  }

  std::vector<int> listed_nodes(const pugi::xml_node& node) const {
    std::vector<int> places;
    for (const int id : file_.ids(node)) places.push_back(place_of(node, id));
    for (const pugi::xml_node& one : node.children("n")) places.push_back(place_of(one, id_of(one)));
    return places;
  }

  template <std::size_t kCount>
  std::array<int, kCount> nodes_of(const pugi::xml_node& node) const {
    const std::vector<int> places = listed_nodes(node);
    if (places.size() != kCount) {
      throw file_.error(node, fmt::format("holds {} nodes; must hold {}", places.size(), kCount));
    }
    std::array<int, kCount> out{};
    std::copy(places.begin(), places.end(), out.begin());
    return out;
  }

  void read_elements(const pugi::xml_node& elements) {
    const std::string type = file_.attribute(elements, "type");
    const bool quadratic = type == "tet10";
    if (!quadratic && type != "tet4" && type != "hex8") {
      file_.cannot(elements, fmt::format("of the type {} (tet4, tet10 and hex8 are read)", type));
      return;
    }
    if (!out_.mesh.corners.empty() && quadratic != out_.mesh.quadratic()) {
      file_.cannot(elements, "mixes tet10 with other types (a model must be all of tet10, or of tet4 and hex8)");
      return;
    }
    out_.parts.push_back({file_.attribute(elements, "name"), {}});
    for (const pugi::xml_node& element : elements.children("elem")) {
      out_.parts.back().tets.emplace_back();
      if (type == "tet4") add_tet(nodes_of<4>(element));
      if (type == "hex8") add_hexahedron(nodes_of<8>(element));
      if (quadratic) {
        const std::array<int, 10> nodes = nodes_of<10>(element);
        add_tet({nodes[0], nodes[1], nodes[2], nodes[3]});
        out_.mesh.midsides.push_back({nodes[4], nodes[5], nodes[6], nodes[7], nodes[8], nodes[9]});
      }
    }
  }

  void add_tet(const std::array<int, 4>& corners) {
    out_.parts.back().tets.back().push_back(static_cast<int>(out_.mesh.corners.size()));
    out_.mesh.corners.push_back(corners);
  }

  void add_hexahedron(const std::array<int, 8>& nodes) {
    out_.has_hexahedra = true;
    const int centre = static_cast<int>(out_.mesh.nodes_m.size());
    Vec3 middle = Vec3::Zero();
    for (const int node : nodes) middle += out_.mesh.nodes_m[at(node)] / 8.0;
    out_.mesh.nodes_m.push_back(middle);
    for (const auto& face : kHexFaces) {
      for (const auto& [a, b, c] : halves({nodes[face[0]], nodes[face[1]], nodes[face[2]], nodes[face[3]]})) {
        add_tet({a, c, b, centre});
      }
    }
  }

  void read_surface(const pugi::xml_node& surface) {
    std::vector<std::array<int, 3>> triangles;
    for (const pugi::xml_node& face : surface.children()) {
      if (face.type() != pugi::node_element) continue;
      const std::string type = face.name();
      const std::vector<int> nodes = listed_nodes(face);
      if ((type == "tri3" && nodes.size() == 3) || (type == "tri6" && nodes.size() == 6)) {
        triangles.push_back({nodes[0], nodes[1], nodes[2]});
      } else if (type == "quad4" && nodes.size() == 4) {
        for (const auto& half : halves({nodes[0], nodes[1], nodes[2], nodes[3]})) triangles.push_back(half);
      } else {
        throw file_.error(face, fmt::format("is a face of {} nodes; tri3, tri6 and quad4 are read", nodes.size()));
      }
    }
    out_.surfaces[file_.attribute(surface, "name")] = std::move(triangles);
  }

  void read_rest(const pugi::xml_node& child) {
    if (child.type() != pugi::node_element) return;
    const std::string name = child.name();
    if (name == "Surface") return read_surface(child);
    if (name == "Nodes" || name == "Elements" || name == "NodeSet" || name == "ElementSet" || name == "PartList")
      return;
    if (name == "SurfacePair" || name == "DiscreteSet") return file_.note_left_out(child);  // refused where it is used
    file_.cannot(child, "in <Mesh>");
  }

  FebioFile& file_;
  pugi::xml_node node_;
  FebioMesh out_;
  std::unordered_map<int, int> place_;  // of a node, by its id
};

}  // namespace

FebioMesh read_febio_mesh(FebioFile& file) {
  return FebioMeshReader(file).read();
}

}  // namespace myotact::exchange
