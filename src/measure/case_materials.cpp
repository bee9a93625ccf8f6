#include "measure/case_materials.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "measure/case_laws.h"

namespace myotact::measure {

namespace {

/// A value that several entries of a region may name, but not differently.
void take_once(JsonObject& parameters, const char* key, double lowest, std::optional<double>& value) {
  const auto found = parameters.find(key);
  if (!found) return;
  const double number = found->number_between(lowest, kLargest_Pa);
  if (value && *value != number) {
    throw found->error(
        fmt::format("is {}, but another entry of the region says {}; give it once", to_text(number), to_text(*value)));
  }
  value = number;
}

void add_entry(const JsonValue& value, std::map<int, CaseMaterial>& regions, const std::set<int>& present) {
  JsonObject entry(value);
  constexpr int kLargestRegion = 1'000'000;  // as mesh files hold
  const auto region = entry.find("region");
  const int number = region ? region->integer_between(-kLargestRegion, kLargestRegion) : 0;
  if (!present.contains(number)) {
    std::vector<std::string> names;
    for (const int other : present) names.push_back(std::to_string(other));
    names.resize(std::min<std::size_t>(names.size(), 10));
    throw value.error(fmt::format("no tet has the region {}; the mesh has {}", number, join(names)));
  }
  const JsonValue law = entry.at("law");
  JsonObject parameters(entry.at("parameters"));
  CaseMaterial& material = regions[number];
  take_once(parameters, "density_kg_m3", 1e-6, material.density_kg_m3);
  take_once(parameters, "fluctuation_Pa", -1.0, material.fluctuation_Pa);
  material.laws.push_back(read_law(law, parameters));
  parameters.finish();
  entry.finish();
}

/// What the tets ask of their materials, the other way round.
void check_tets(const JsonValue& value, const SolveCase& out) {
  for (std::size_t tet = 0; tet < out.material_of_tet.size(); ++tet) {
    const auto& laws = out.materials[static_cast<std::size_t>(out.material_of_tet[tet])].laws;
    if (std::none_of(laws.begin(), laws.end(), follows_fibre)) continue;
    if (!out.mesh.fibres.empty() && out.mesh.fibres[tet].norm() > 0.5) continue;
    const bool of_file = out.mesh.file != value.file();  // not a box, which has no cell vectors
    throw value.error(fmt::format("tet {} of region {} has no fibre and a law needs one; give \"fibre\" a direction{}",
                                  tet, out.mesh.regions[tet],
                                  of_file ? ", or the mesh " + out.mesh.file + " unit cell vectors \"fibre\"" : ""));
  }
}

}  // namespace

void read_materials(const JsonValue& value, SolveCase& out) {
  const std::set<int> present(out.mesh.regions.begin(), out.mesh.regions.end());
  std::map<int, CaseMaterial> regions;
  for (const JsonValue& entry : value.elements()) add_entry(entry, regions, present);
  std::map<int, int> index;
  for (const int region : present) {
    const auto found = regions.find(region);
    if (found == regions.end()) {
      const auto tet = std::find(out.mesh.regions.begin(), out.mesh.regions.end(), region) - out.mesh.regions.begin();
      throw value.error(fmt::format("tet {} has the region {}, which has no material; add one", tet, region));
    }
    const auto& laws = found->second.laws;
    if (std::none_of(laws.begin(), laws.end(), carries_shear)) {
      throw value.error(fmt::format("region {} has no matrix, only fibres; add a law such as neo_hookean", region));
    }
    index[region] = static_cast<int>(out.materials.size());
    out.materials.push_back(found->second);
  }
  for (const int region : out.mesh.regions) out.material_of_tet.push_back(index[region]);
  check_tets(value, out);
}

}  // namespace myotact::measure
