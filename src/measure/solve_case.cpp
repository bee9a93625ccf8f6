#include "measure/solve_case.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/json_reader.h"
#include "core/text.h"
#include "measure/case_conditions.h"
#include "measure/case_materials.h"
#include "measure/case_mesh.h"
#include "measure/case_outputs.h"
#include "measure/case_sets.h"
#include "measure/case_supports.h"

namespace myotact::measure {

namespace {

void read_dynamics(JsonObject& fields, SolveCase& out) {
  const auto dynamics = fields.find("dynamics");
  const std::string kind = dynamics ? dynamics->one_of({"static", "bdf2", "backward_euler"}) : "static";
  const auto dt = fields.find("dt_s");
  const auto t_end = fields.find("t_end_s");
  if (kind == "static") {
    if (dt) throw dt->error("a static case has no time step; leave it out, or choose other dynamics");
    if (t_end) throw t_end->error("a static case has no time; leave it out, or choose other dynamics");
    return;
  }
  out.dynamics = kind == "bdf2" ? Dynamics::Bdf2 : Dynamics::BackwardEuler;
  constexpr double kShortest_s = 1e-9, kLongest_s = 1e6, kMostSteps = 1e7;
  out.dt_s = fields.at("dt_s").number_between(kShortest_s, kLongest_s);
  out.t_end_s = fields.at("t_end_s").number_between(out.dt_s, std::min(kLongest_s, kMostSteps * out.dt_s));
}

/// A body with weight or inertia needs its mass; there is no density that would be right for all.
void require_density(const JsonValue& materials, const SolveCase& out) {
  const bool moves = out.dynamics != Dynamics::Static;
  if (!moves && out.loads.gravity_m_s2.isZero(0.0)) return;
  for (std::size_t m = 0; m < out.materials.size(); ++m) {
    if (out.materials[m].density_kg_m3) continue;
    const auto tet = std::find(out.material_of_tet.begin(), out.material_of_tet.end(), static_cast<int>(m));
    const int region = out.mesh.regions[static_cast<std::size_t>(tet - out.material_of_tet.begin())];
    throw materials.error(fmt::format("region {} has no density_kg_m3, and {} needs one; add it to the parameters",
                                      region, moves ? "motion" : "gravity"));
  }
}

Element element_of(const JsonValue& value) {
  const std::string name = value.one_of({"T4", "T4F", "T10"});
  return name == "T4" ? Element::T4 : name == "T4F" ? Element::T4F : Element::T10;
}

}  // namespace

SolveCase load_case(const std::filesystem::path& path) {
  const nlohmann::json json = read_json(path);
  const JsonValue root(json, path.string());
  JsonObject fields(root);
  fields.at("schema").integer_between(1, 1);
  SolveCase out;
  out.name = path.stem().string();
  // All keys are known before the mesh is read, so that a slip in one does not wait for a large file.
  const MeshKeys keys{fields.at("mesh"), fields.find("fibre"), element_of(fields.at("element"))};
  out.element = keys.element;
  read_dynamics(fields, out);
  const JsonValue materials = fields.at("materials");
  const auto sets_value = fields.find("sets");
  const JsonValue conditions = fields.at("conditions");
  const JsonValue outputs = fields.at("outputs");
  constexpr double kFinest = 1e-14, kCoarsest = 0.1;
  if (const auto tolerance = fields.find("tolerance")) out.tolerance = tolerance->number_between(kFinest, kCoarsest);
  fields.finish();
  out.mesh = read_case_mesh(keys);
  read_materials(materials, out);
  const NodeSets sets = read_sets(sets_value, out.mesh);
  read_conditions(conditions, sets, out);
  require_density(materials, out);
  if (out.dynamics == Dynamics::Static) check_supports(out);
  out.outputs = read_outputs(outputs, sets, out);
  return out;
}

}  // namespace myotact::measure
