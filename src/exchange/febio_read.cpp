#include "exchange/febio_read.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/at.h"
#include "core/text.h"
#include "exchange/febio_conditions.h"
#include "exchange/febio_file.h"
#include "exchange/febio_mesh.h"
#include "exchange/febio_read_laws.h"
#include "measure/case_laws.h"
#include "measure/case_mesh.h"
#include "measure/case_supports.h"

namespace myotact::exchange {

namespace {

using measure::Dynamics;

bool has_elements(const pugi::xml_node& node) {
  return std::any_of(node.begin(), node.end(), [](const auto& child) { return child.type() == pugi::node_element; });
}

class FebioReader {
 public:
  explicit FebioReader(FebioFile file) : file_(std::move(file)) {}

  FebioCase read() {
    measure::SolveCase& out = out_.solve_case;
    out.name = std::filesystem::path(file_.name()).stem().string();
    sort_sections();
    read_control();
    const FebioMesh mesh = read_febio_mesh(file_);
    read_materials();
    assign_materials(mesh);
    file_.refuse_all();
    make_mesh(mesh);
    read_febio_conditions(sections_, mesh, file_, out);
    file_.refuse_all();
    take_activation();
    check_laws();
    add_outputs(mesh);
    if (out.dynamics == Dynamics::Static) measure::check_supports(out);
    out_.left_out = file_.left_out();
    return std::move(out_);
  }

 private:
  /// Those of the model, and those of its one step.
  void sort_sections() {
    control_ = file_.root().child("Control");
    std::vector<pugi::xml_node> all;
    for (const pugi::xml_node& section : file_.root().children()) {
      if (section.type() != pugi::node_element) continue;
      if (std::string(section.name()) != "Step") {
        all.push_back(section);
        continue;
      }
      int steps = 0;
      for (const pugi::xml_node& step : section.children("step")) {
        if (++steps > 1) file_.cannot(step, "after another one (one step is read)");
        if (const pugi::xml_node control = step.child("Control")) control_ = control;
        for (const pugi::xml_node& inner : step.children()) {
          if (inner.type() == pugi::node_element) all.push_back(inner);
        }
      }
    }
    for (const pugi::xml_node& section : all) sort(section);
  }

  void sort(const pugi::xml_node& section) {
    const std::string name = section.name();
    if (name == "Boundary") return sections_.boundary.push_back(section);
    if (name == "Loads") return sections_.loads.push_back(section);
    for (const char* read : {"Module", "Control", "Material", "Mesh", "MeshDomains", "MeshData", "LoadData"}) {
      if (name == read) return;
    }
    if (name == "Output" || name == "Globals" || !has_elements(section)) return file_.note_left_out(section);
    file_.cannot(section, "as a whole");
  }

  void read_control() {
    measure::SolveCase& out = out_.solve_case;
    if (!control_) throw file_.error(file_.root(), "has no <Control>; add it");
    const double steps = file_.value(control_, "time_steps"), step_s = file_.value(control_, "step_size");
    constexpr double kMostSteps = 1e7;
    if (!(steps >= 1.0 && steps <= kMostSteps && steps == std::floor(steps))) {
      throw file_.error(control_.child("time_steps"), fmt::format("is {}; must be 1 to 1e7", to_text(steps)));
    }
    if (!(step_s > 0.0 && step_s * steps <= 1e6)) {
      throw file_.error(control_.child("step_size"),
                        fmt::format("is {}; must be > 0, and all steps at most 1e6 s long", to_text(step_s)));
    }
    const std::string analysis = lower(control_.child_value("analysis"));
    if (analysis == "dynamic") {
      out.dynamics = Dynamics::Bdf2;
      out.dt_s = step_s;
      out.t_end_s = steps * step_s;
    } else if (analysis == "static" || analysis.empty()) {
      constexpr double kMostLoadSteps = 10'000;
      out.load_steps = static_cast<int>(std::min(steps, kMostLoadSteps));
    } else {
      file_.cannot(control_.child("analysis"), fmt::format("\"{}\"", analysis));
    }
    file_.read_curves(steps * step_s);
  }

  void read_materials() {
    for (const pugi::xml_node& node : file_.root().child("Material").children("material")) {
      const std::string name = file_.attribute(node, "name");
      if (!index_.emplace(name, materials_.size()).second) {
        throw file_.error(node, fmt::format("has the name \"{}\" again; names must differ", name));
      }
      materials_.push_back(read_febio_material(node, out_.solve_case.dynamics != Dynamics::Static, file_));
    }
  }

  /// A material for every part; of the element what its kind of tets or its domain says.
  void assign_materials(const FebioMesh& mesh) {
    material_of_part_.assign(mesh.parts.size(), -1);
    bool averaged = false;
    for (const pugi::xml_node& domain : file_.root().child("MeshDomains").children()) {
      if (domain.type() != pugi::node_element) continue;
      if (std::string(domain.name()) != "SolidDomain") {
        file_.cannot(domain, "in <MeshDomains>");
        continue;
      }
      const std::string type = domain.attribute("type").value();
      averaged |= type == "ut4-solid";
      if (!type.empty() && type != "ut4-solid" && type != "elastic-solid" && type != "three-field-solid") {
        file_.cannot(domain, fmt::format("of the type \"{}\"", type));
      }
      const std::string name = file_.attribute(domain, "name"), material = file_.attribute(domain, "mat");
      const auto found = index_.find(material);
      if (found == index_.end()) {
        throw file_.error(domain, fmt::format("names the material \"{}\", which there is not", material));
      }
      for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
        if (mesh.parts[p].name == name) material_of_part_[p] = static_cast<int>(found->second);
      }
    }
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
      if (material_of_part_[p] >= 0) continue;
      throw file_.error(file_.child(file_.root(), "MeshDomains"),
                        fmt::format("has no <SolidDomain> for the elements \"{}\"", mesh.parts[p].name));
    }
    const bool quadratic = mesh.mesh.quadratic() || mesh.has_hexahedra;
    out_.solve_case.element = quadratic  ? measure::Element::T10
                              : averaged ? measure::Element::T4F
                                         : measure::Element::T4;
  }

  void make_mesh(const FebioMesh& mesh) {
    geometry::TetFile tets;
    tets.mesh = mesh.mesh;
    tets.regions.assign(mesh.mesh.corners.size(), 0);
    tets.fibres.assign(mesh.mesh.corners.size(), Vec3::Zero());
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
      const FebioReadMaterial& material = materials_[at(material_of_part_[p])];
      const Vec3 usual = material.fibre.value_or(material.follows_axes ? Vec3(Vec3::UnitX()) : Vec3(Vec3::Zero()));
      for (const std::vector<int>& element : mesh.parts[p].tets) {
        for (const int t : element) {
          tets.regions[at(t)] = material_of_part_[p];
          tets.fibres[at(t)] = usual;
        }
      }
    }
    for (const pugi::xml_node& data : file_.root().child("MeshData").children("ElementData")) {
      read_directions(data, mesh, tets);
    }
    measure::SolveCase& out = out_.solve_case;
    out.mesh = measure::make_case_mesh(std::move(tets), out.element, file_.name());
    out.material_of_tet = out.mesh.regions;
    for (const FebioReadMaterial& material : materials_) {
      out.materials.push_back({material.laws, material.density_kg_m3, {}});
    }
  }

  void read_directions(const pugi::xml_node& data, const FebioMesh& mesh, geometry::TetFile& tets) {
    const std::string type = data.attribute("type") ? data.attribute("type").value() : data.attribute("var").value();
    if (type != "mat_axis" && type != "fiber") return file_.cannot(data, fmt::format("of the type \"{}\"", type));
    const std::string name = file_.attribute(data, "elem_set");
    const auto part =
        std::find_if(mesh.parts.begin(), mesh.parts.end(), [&](const FebioPart& one) { return one.name == name; });
    if (part == mesh.parts.end()) {
      throw file_.error(data, fmt::format("is of the elements \"{}\", which <Mesh> does not have as such", name));
    }
    const auto place = static_cast<std::size_t>(part - mesh.parts.begin());
    const Vec3 local = materials_[at(material_of_part_[place])].fibre.value_or(Vec3::UnitX());
    for (const pugi::xml_node& entry : data.children("elem")) {
      const int lid = entry.attribute("lid").as_int(0);
      if (lid < 1 || at(lid) > part->tets.size()) {
        throw file_.error(entry, fmt::format("has the lid {}; the elements have 1 to {}", lid, part->tets.size()));
      }
      const Vec3 fibre = type == "fiber" ? file_.vector(entry) : Vec3(axes_of(entry) * local);
      const double length = fibre.stableNorm();
      if (!(length > 0.0 && std::isfinite(length))) throw file_.error(entry, "has no direction; must be longer than 0");
      for (const int t : part->tets[at(lid) - 1]) tets.fibres[at(t)] = fibre / length;
    }
  }

  /// First axis along a, third across a and d.
  Mat3 axes_of(const pugi::xml_node& entry) const {
    const Vec3 a = file_.vector(file_.child(entry, "a")), d = file_.vector(file_.child(entry, "d"));
    const Vec3 across = a.cross(d);
    if (!(across.stableNorm() > 0.0) || !across.allFinite())
      throw file_.error(entry, "has axes a and d that are parallel");
    Mat3 axes;
    axes.col(0) = a.stableNormalized();
    axes.col(2) = across.stableNormalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
  }

  /// One for all: that of the fibres. Tensions of their own are given for full load, so they are divided by it.
  void take_activation() {
    measure::SolveCase& out = out_.solve_case;
    std::optional<double> activation;
    for (const FebioReadMaterial& material : materials_) {
      if (!material.activation) continue;
      if (activation && *activation != *material.activation) {
        throw bad_data(file_.name(), "<Material>",
                       fmt::format("has fibres with the activations {} and {} at the end; one for all is read",
                                   to_text(*activation), to_text(*material.activation)));
      }
      activation = material.activation;
      out.activation_ramp_s = material.rise_s;
    }
    out.loads.activation = activation.value_or(1.0);
    if (out.loads.activation == 1.0) return;
    for (measure::CaseMaterial& material : out.materials) {
      for (simulation::Law& law : material.laws) {
        auto* along = std::get_if<simulation::UnsplitFibres<simulation::ConstantTension>>(&law);
        auto* everywhere = std::get_if<simulation::IsotropicTension>(&law);
        if (!along && !everywhere) continue;
        if (out.loads.activation == 0.0) {
          throw bad_data(file_.name(), "<Material>",
                         "has a tension T0 beside fibres of the activation 0; take one out");
        }
        (along ? along->curve.tension_Pa : everywhere->tension_Pa) /= out.loads.activation;
      }
    }
  }

  void check_laws() const {
    const measure::SolveCase& out = out_.solve_case;
    for (const auto& [name, index] : index_) {
      const auto& laws = out.materials[index].laws;
      if (std::any_of(laws.begin(), laws.end(), measure::carries_shear)) continue;
      throw bad_data(file_.name(), fmt::format("material \"{}\"", name),
                     "has nothing that resists shear; add a solid such as neo-Hookean");
    }
  }

  void add_outputs(const FebioMesh& mesh) {
    measure::SolveCase& out = out_.solve_case;
    std::vector<int> nodes, tets;
    for (std::size_t n = 0; n < mesh.nodes_of_file; ++n) {
      if (out.mesh.node_of_file[n] >= 0) nodes.push_back(out.mesh.node_of_file[n]);
    }
    for (std::size_t t = 0; t < out.mesh.mesh.corners.size(); ++t) tets.push_back(static_cast<int>(t));
    using measure::Quantity;
    using measure::Reduction;
    out.outputs.push_back({"all.displacement.l2", Quantity::Displacement, Reduction::L2, nodes, {}});
    out.outputs.push_back({"all.displacement.max", Quantity::Displacement, Reduction::Max, nodes, {}});
    out.outputs.push_back({"all.stress.max", Quantity::Stress, Reduction::Max, {}, tets});
    out.outputs.push_back({"all.volume_ratio.mean", Quantity::VolumeRatio, Reduction::Mean, {}, tets});
    out.outputs.push_back({"all.energy.sum", Quantity::Energy, Reduction::Sum, {}, {}});
  }

  FebioFile file_;
  FebioCase out_;
  pugi::xml_node control_;
  FebioSections sections_;
  std::vector<FebioReadMaterial> materials_;
  std::map<std::string, std::size_t> index_;  // of materials, by name
  std::vector<int> material_of_part_;
};

}  // namespace

FebioCase read_febio(const std::filesystem::path& path) {
  return FebioReader(FebioFile(path)).read();
}

FebioCase parse_febio(const std::string& text, const std::string& name) {
  return FebioReader(FebioFile(text, name)).read();
}

}  // namespace myotact::exchange
