#include "exchange/febio_write.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "core/at.h"
#include "core/text.h"
#include "exchange/febio_laws.h"

namespace myotact::exchange {

namespace {

using measure::Dynamics;
using measure::Element;
using measure::SolveCase;

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

std::string listed(const Vec3& v) {
  return to_text(v.x()) + "," + to_text(v.y()) + "," + to_text(v.z());
}

/// A load that grows with the steps of a static case and acts from the start in motion.
const char* raised(const SolveCase& input) {
  return input.dynamics == Dynamics::Static ? " lc=\"1\"" : "";
}

class FebioWriter {
 public:
  FebioWriter(const SolveCase& input, std::vector<std::string> notes, const std::vector<double>& activations)
      : in_(input), activations_(activations), notes_(std::move(notes)) {}

  FebioText write() {
    add_control();
    add_materials();
    add_mesh();
    add_domains();
    add_boundary();
    add_loads();
    add_data();
    FebioText out;
    out.text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + comment() + "<febio_spec version=\"4.0\">\n" +
               control_ + materials_ + mesh_ + "</Mesh>\n" + domains_ + mesh_data_ + "</MeshData>\n" + boundary_ +
               loads_ + data_ + "</febio_spec>\n";
    out.notes = notes_;
    return out;
  }

 private:
  const geometry::TetMesh& mesh() const { return in_.mesh.mesh; }

  /// Two hyphens would end a comment too early.
  std::string comment() const {
    std::string text = "<!-- Written by Myotact; SI units. Nothing of this was run in FEBio where it was written.\n";
    for (const std::string& note : notes_) text += note + "\n";
    for (std::size_t at_hyphens; (at_hyphens = text.find("--", 4)) != std::string::npos;) text[at_hyphens] = '~';
    return text + "-->\n";
  }

  void add_control() {
    const bool is_static = in_.dynamics == Dynamics::Static;
    const int steps = is_static ? in_.load_steps : std::max(1, static_cast<int>(std::lround(in_.t_end_s / in_.dt_s)));
    control_ = fmt::format(
        "<Module type=\"solid\"/>\n<Control>\n<analysis>{}</analysis>\n<time_steps>{}</time_steps>\n"
        "<step_size>{}</step_size>\n<solver type=\"solid\">\n<symmetric_stiffness>symmetric</symmetric_stiffness>\n"
        "<dtol>1e-8</dtol>\n<etol>1e-12</etol>\n<rtol>0</rtol>\n<max_refs>60</max_refs>\n</solver>\n</Control>\n",
        is_static ? "STATIC" : "DYNAMIC", steps, to_text(is_static ? 1.0 / steps : in_.dt_s));
    if (!is_static) {
      notes_.push_back(fmt::format("Motion: the case asks for {}; FEBio's own time rule differs from it.",
                                   in_.dynamics == Dynamics::Bdf2 ? "bdf2" : "backward_euler"));
    }
  }

  void add_materials() {
    materials_ = "<Material>\n";
    for (std::size_t m = 0; m < in_.materials.size(); ++m) {
      const measure::CaseMaterial& material = in_.materials[m];
      const double activation = activations_.empty() ? in_.loads.activation : activations_[m];
      FebioMaterial part = febio_material(material, material_name(m), static_cast<int>(m) + 1, activation);
      materials_ += part.text;
      for (std::string& note : part.notes) notes_.push_back(material_name(m) + ": " + std::move(note));
      if (material.fluctuation_Pa) {
        notes_.push_back(
            fmt::format("{}: fluctuation_Pa {} has no like in FEBio, which integrates the volume term at "
                        "each point.",
                        material_name(m), to_text(*material.fluctuation_Pa)));
      }
    }
    materials_ += "</Material>\n";
    if (in_.element == Element::T10) {
      notes_.emplace_back(
          "T10: here the volume term goes by each tet's mean; FEBio's tet10 has it at each point. The two "
          "agree as the mesh gets finer.");
    }
    if (in_.element == Element::T4F) {
      notes_.emplace_back(
          "T4F: FEBio's nearest is ut4-solid, which averages over nodes where T4F averages over patches.");
    }
  }

  static std::string material_name(std::size_t material) { return fmt::format("material_{}", material + 1); }
  static std::string part_name(std::size_t material) { return fmt::format("part_{}", material + 1); }

  void add_mesh() {
    mesh_ = "<Mesh>\n<Nodes name=\"nodes\">\n";
    for (std::size_t n = 0; n < mesh().nodes_m.size(); ++n) {
      mesh_ += fmt::format("<node id=\"{}\">{}</node>\n", n + 1, listed(mesh().nodes_m[n]));
    }
    mesh_ += "</Nodes>\n";
    mesh_data_ = "<MeshData>\n";
    for (std::size_t m = 0; m < in_.materials.size(); ++m) add_part(m);
  }

  void add_part(std::size_t material) {
    mesh_ +=
        fmt::format("<Elements type=\"{}\" name=\"{}\">\n", mesh().quadratic() ? "tet10" : "tet4", part_name(material));
    std::string axes;
    std::size_t place = 0;
    for (std::size_t t = 0; t < mesh().corners.size(); ++t) {
      if (in_.material_of_tet[t] != static_cast<int>(material)) continue;
      std::string nodes;
      for (const int node : mesh().corners[t]) nodes += fmt::format("{},", node + 1);
      if (mesh().quadratic()) {
        for (const int node : mesh().midsides[t]) nodes += fmt::format("{},", node + 1);
      }
      nodes.pop_back();
      mesh_ += fmt::format("<elem id=\"{}\">{}</elem>\n", t + 1, nodes);
      ++place;
      if (in_.mesh.fibres.empty() || in_.mesh.fibres[t].isZero(0.0)) continue;
      const Vec3& fibre = in_.mesh.fibres[t];
      Eigen::Index across = 0;
      fibre.cwiseAbs().minCoeff(&across);
      axes +=
          fmt::format("<elem lid=\"{}\"><a>{}</a><d>{}</d></elem>\n", place, listed(fibre), listed(Vec3::Unit(across)));
    }
    mesh_ += "</Elements>\n";
    if (axes.empty()) return;
    mesh_data_ +=
        fmt::format("<ElementData type=\"mat_axis\" elem_set=\"{}\">\n{}</ElementData>\n", part_name(material), axes);
  }

  void add_domains() {
    domains_ = "<MeshDomains>\n";
    for (std::size_t m = 0; m < in_.materials.size(); ++m) {
      domains_ += fmt::format("<SolidDomain name=\"{}\" mat=\"{}\"{}/>\n", part_name(m), material_name(m),
                              in_.element == Element::T4F ? " type=\"ut4-solid\"" : "");
    }
    domains_ += "</MeshDomains>\n";
  }

  void add_node_set(const std::string& name, const std::vector<int>& nodes) {
    mesh_ += fmt::format("<NodeSet name=\"{}\">\n", name);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      mesh_ += fmt::format("{}{}", nodes[k] + 1, k + 1 == nodes.size() ? "\n" : (k % 16 == 15 ? ",\n" : ","));
    }
    mesh_ += "</NodeSet>\n";
  }

  /// What is fixed in all three directions, in two or in one; then what is moved, with a value a node.
  void add_boundary() {
    std::map<int, std::array<bool, 3>> fixed;
    std::array<std::vector<std::pair<int, double>>, 3> moved;
    for (const simulation::HeldDof& held : in_.loads.held) {
      if (held.displacement_m == 0.0) {
        fixed[held.node][at(held.component)] = true;
      } else {
        moved[at(held.component)].emplace_back(held.node, held.displacement_m);
      }
    }
    std::map<std::array<bool, 3>, std::vector<int>> alike;
    for (const auto& [node, components] : fixed) alike[components].push_back(node);
    boundary_ = "<Boundary>\n";
    for (const auto& [components, nodes] : alike) {
      std::string name = "fixed_";
      std::string content;
      for (std::size_t k = 0; k < 3; ++k) {
        if (components[k]) name += kAxes[k];
        content += fmt::format("<{}_dof>{}</{}_dof>\n", kAxes[k], components[k] ? 1 : 0, kAxes[k]);
      }
      add_node_set(name, nodes);
      boundary_ +=
          fmt::format("<bc name=\"{}\" node_set=\"{}\" type=\"zero displacement\">\n{}</bc>\n", name, name, content);
    }
    for (std::size_t k = 0; k < 3; ++k) add_moved(kAxes[k], moved[k]);
    boundary_ += "</Boundary>\n";
  }

  void add_moved(const std::string& axis, const std::vector<std::pair<int, double>>& moved) {
    if (moved.empty()) return;
    const std::string name = "moved_" + axis;
    std::vector<int> nodes;
    mesh_data_ += fmt::format("<NodeData name=\"{}_m\" node_set=\"{}\" data_type=\"scalar\">\n", name, name);
    for (const auto& [node, displacement_m] : moved) {
      nodes.push_back(node);
      mesh_data_ += fmt::format("<node lid=\"{}\">{}</node>\n", nodes.size(), to_text(displacement_m));
    }
    mesh_data_ += "</NodeData>\n";
    add_node_set(name, nodes);
    boundary_ += fmt::format(
        "<bc name=\"{0}\" node_set=\"{0}\" type=\"prescribed displacement\">\n<dof>{1}</dof>\n"
        "<value{2} type=\"map\">{0}_m</value>\n<relative>0</relative>\n</bc>\n",
        name, axis, raised(in_));
  }

  void add_loads() {
    loads_ = "<Loads>\n";
    add_forces();
    std::map<double, std::vector<const simulation::PressureFace*>> by_pressure;
    for (const simulation::PressureFace& face : in_.loads.pressure) by_pressure[face.pressure_Pa].push_back(&face);
    int number = 0;
    for (const auto& [pressure_Pa, faces] : by_pressure) add_pressure(++number, pressure_Pa, faces);
    if (!in_.loads.gravity_m_s2.isZero(0.0)) {
      // FEBio subtracts body forces.
      loads_ += fmt::format("<body_load type=\"body force\">\n<force{}>{}</force>\n</body_load>\n", raised(in_),
                            listed(-in_.loads.gravity_m_s2));
    }
    loads_ += "</Loads>\n";
  }

  void add_forces() {
    std::vector<int> nodes;
    std::string values;
    for (Eigen::Index k = 0; k < in_.loads.nodal_force_N.size(); k += 3) {
      const Vec3 force_N = in_.loads.nodal_force_N.segment<3>(k);
      if (force_N.isZero(0.0)) continue;
      nodes.push_back(static_cast<int>(k / 3));
      values += fmt::format("<node lid=\"{}\">{}</node>\n", nodes.size(), listed(force_N));
    }
    if (nodes.empty()) return;
    add_node_set("pulled", nodes);
    mesh_data_ += "<NodeData name=\"pulled_N\" node_set=\"pulled\" data_type=\"vec3\">\n" + values + "</NodeData>\n";
    loads_ += fmt::format(
        "<nodal_load name=\"pulled\" node_set=\"pulled\" type=\"nodal_force\">\n<value{} "
        "type=\"map\">pulled_N</value>\n"
        "</nodal_load>\n",
        raised(in_));
  }

  void add_pressure(int number, double pressure_Pa, const std::vector<const simulation::PressureFace*>& faces) {
    const std::string name = fmt::format("pressed_{}", number);
    mesh_ += fmt::format("<Surface name=\"{}\">\n", name);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto& n = faces[f]->nodes;
      mesh_ += faces[f]->quadratic
                   ? fmt::format("<tri6 id=\"{}\">{},{},{},{},{},{}</tri6>\n", f + 1, n[0] + 1, n[1] + 1, n[2] + 1,
                                 n[3] + 1, n[4] + 1, n[5] + 1)
                   : fmt::format("<tri3 id=\"{}\">{},{},{}</tri3>\n", f + 1, n[0] + 1, n[1] + 1, n[2] + 1);
    }
    mesh_ += "</Surface>\n";
    loads_ += fmt::format(
        "<surface_load name=\"{0}\" surface=\"{0}\" type=\"pressure\">\n<pressure{1}>{2}</pressure>\n"
        "<linear>0</linear>\n<symmetric_stiffness>1</symmetric_stiffness>\n</surface_load>\n",
        name, raised(in_), to_text(pressure_Pa));
  }

  /// Curve 1: loads and activation of a static case, the activation in motion.
  void add_data() {
    const bool rises = in_.dynamics == Dynamics::Static || in_.activation_ramp_s > 0.0;
    const double until = in_.dynamics == Dynamics::Static || !rises ? 1.0 : in_.activation_ramp_s;
    data_ = fmt::format(
        "<LoadData>\n<load_controller id=\"1\" name=\"rising\" type=\"loadcurve\">\n<interpolate>LINEAR</interpolate>\n"
        "<extend>CONSTANT</extend>\n<points>\n<pt>0,{}</pt>\n<pt>{},1</pt>\n</points>\n</load_controller>\n</"
        "LoadData>\n"
        "<Output>\n<plotfile type=\"febio\">\n<var type=\"displacement\"/>\n<var type=\"stress\"/>\n"
        "<var type=\"relative volume\"/>\n</plotfile>\n</Output>\n",
        rises ? 0 : 1, to_text(until));
  }

  const SolveCase& in_;
  const std::vector<double>& activations_;
  std::vector<std::string> notes_;
  std::string control_, materials_, mesh_, domains_, mesh_data_, boundary_, loads_, data_;
};

}  // namespace

FebioText febio_text(const measure::SolveCase& input, std::vector<std::string> notes,
                     const std::vector<double>& activations) {
  return FebioWriter(input, std::move(notes), activations).write();
}

}  // namespace myotact::exchange
