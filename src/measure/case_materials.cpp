#include "measure/case_materials.h"

#include <algorithm>
#include <set>
#include <type_traits>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::measure {

namespace {

using namespace simulation;

/// A stiffness or stress beyond diamond's thousandfold is a slip of units.
constexpr double kLargest_Pa = 1e15;

double positive(JsonObject& fields, const char* key, double largest = kLargest_Pa) {
  const JsonValue value = fields.at(key);
  const double number = value.number();
  if (!(number > 0.0 && number <= largest)) {
    throw value.error(fmt::format("is {}; must be > 0 and at most {}", to_text(number), to_text(largest)));
  }
  return number;
}

double positive_or(JsonObject& fields, const char* key, double fallback, double largest = kLargest_Pa) {
  return fields.find(key) ? positive(fields, key, largest) : fallback;
}

double not_negative_or(JsonObject& fields, const char* key, double fallback, double largest = kLargest_Pa) {
  const auto value = fields.find(key);
  return value ? value->number_between(0.0, largest) : fallback;
}

struct Lame {
  double shear_Pa = 0.0, lambda_Pa = 0.0;
};

/// Either shear_Pa and lambda_Pa, or young_Pa and poisson.
Lame read_lame(JsonObject& fields) {
  const bool by_young = fields.find("young_Pa").has_value() || fields.find("poisson").has_value();
  const bool by_shear = fields.find("shear_Pa").has_value() || fields.find("lambda_Pa").has_value();
  if (by_young && by_shear) {
    throw fields.value().error("mixes two ways: give shear_Pa and lambda_Pa, or young_Pa and poisson");
  }
  if (by_young) {
    const double young_Pa = positive(fields, "young_Pa");
    const JsonValue poisson = fields.at("poisson");
    const double nu = poisson.number();
    if (!(nu > -1.0 && nu < 0.5)) {
      throw poisson.error(fmt::format("is {}; must be > -1 and < 0.5 (0.499 is nearly incompressible)", to_text(nu)));
    }
    return {young_Pa / (2.0 * (1.0 + nu)), young_Pa * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))};
  }
  const double shear_Pa = positive(fields, "shear_Pa");
  const JsonValue lambda = fields.at("lambda_Pa");
  const double lambda_Pa = lambda.number();
  const double least_Pa = -2.0 / 3.0 * shear_Pa;  // bulk modulus 0
  if (!(lambda_Pa > least_Pa && lambda_Pa <= kLargest_Pa)) {
    throw lambda.error(fmt::format("is {}; must be > {} (or the bulk modulus is not positive) and at most {}",
                                   to_text(lambda_Pa), to_text(least_Pa), to_text(kLargest_Pa)));
  }
  return {shear_Pa, lambda_Pa};
}

template <class Matrix>
Law read_two_moduli(JsonObject& fields) {
  const Lame lame = read_lame(fields);
  return Matrix{lame.shear_Pa, lame.lambda_Pa};
}

Law read_mooney_rivlin(JsonObject& fields) {
  const double c1_Pa = positive(fields, "c1_Pa");
  return MooneyRivlin{c1_Pa, not_negative_or(fields, "c2_Pa", 0.0), positive(fields, "bulk_Pa")};
}

constexpr double kLargestPure = 1e3;  // of stretches, exponents and other numbers without a unit

MuscleFibre muscle_fibre(JsonObject& fields) {
  MuscleFibre fibre;
  fibre.peak_Pa = positive(fields, "peak_Pa");
  fibre.rest_length = positive_or(fields, "rest_length", fibre.rest_length, kLargestPure);
  fibre.gain = positive_or(fields, "gain", fibre.gain, kLargestPure);
  if (const auto curves = fields.find("curves")) fibre.curves = *find_curve_set(curves->one_of(curve_set_names()));
  return fibre;
}

BlemkerFibre blemker_fibre(JsonObject& fields) {
  BlemkerFibre fibre;
  fibre.peak_Pa = positive(fields, "peak_Pa");
  fibre.optimal_stretch = positive_or(fields, "optimal_stretch", fibre.optimal_stretch, kLargestPure);
  fibre.toe = not_negative_or(fields, "toe", fibre.toe, kLargestPure);
  fibre.exponent = positive_or(fields, "exponent", fibre.exponent, kLargestPure);
  fibre.straight = positive_or(fields, "straight_stretch", fibre.straight, kLargestPure);
  return fibre;
}

ExponentialFibre exponential_fibre(JsonObject& fields) {
  ExponentialFibre fibre;
  fibre.toe_Pa = positive(fields, "toe_Pa");
  fibre.exponent = positive(fields, "exponent", kLargestPure);
  fibre.straight_Pa = not_negative_or(fields, "straight_Pa", fibre.straight_Pa);
  const JsonValue straight = fields.at("straight_stretch");
  fibre.straight = straight.number_between(1.0, kLargestPure);
  return fibre;
}

CalciumTension calcium_tension(JsonObject& fields) {
  CalciumTension fibre;
  fibre.largest_Pa = positive(fields, "peak_Pa");
  fibre.calcium = positive(fields, "calcium_umol", kLargestPure);
  fibre.largest_calcium = positive(fields, "largest_calcium_umol", kLargestPure);
  fibre.steepness_1_um = positive(fields, "steepness_1_um", kLargestPure);
  fibre.shortest_um = positive(fields, "shortest_um", kLargestPure);
  fibre.reference_um = positive(fields, "reference_um", kLargestPure);
  return fibre;
}

template <class Curve>
Law read_blemker(JsonObject& fields, Curve (*curve)(JsonObject&)) {
  const double along_Pa = positive(fields, "along_Pa");
  const double across_Pa = positive(fields, "across_Pa");
  return BlemkerMuscle<Curve>{along_Pa, across_Pa, positive(fields, "bulk_Pa"), curve(fields)};
}

struct NamedLaw {
  const char* name;
  Law (*read)(JsonObject& fields);
};

const std::vector<NamedLaw>& known_laws() {
  static const std::vector<NamedLaw> kLaws = {
      {"stable_neo_hookean", read_two_moduli<StableNeoHookean>},
      {"neo_hookean", read_two_moduli<NeoHookean>},
      {"corotated", read_two_moduli<Corotated>},
      {"mooney_rivlin", read_mooney_rivlin},
      {"blemker_muscle", [](JsonObject& f) { return read_blemker(f, blemker_fibre); }},
      {"blemker_tendon", [](JsonObject& f) { return read_blemker(f, exponential_fibre); }},
      {"muscle_fibre", [](JsonObject& f) -> Law { return UnsplitFibres<MuscleFibre>{muscle_fibre(f)}; }},
      {"isochoric_muscle_fibre", [](JsonObject& f) -> Law { return IsochoricFibres<MuscleFibre>{muscle_fibre(f)}; }},
      {"blemker_fibre", [](JsonObject& f) -> Law { return UnsplitFibres<BlemkerFibre>{blemker_fibre(f)}; }},
      {"exponential_fibre", [](JsonObject& f) -> Law { return UnsplitFibres<ExponentialFibre>{exponential_fibre(f)}; }},
      {"isochoric_exponential_fibre",
       [](JsonObject& f) -> Law { return IsochoricFibres<ExponentialFibre>{exponential_fibre(f)}; }},
      {"fibre_tension",
       [](JsonObject& f) -> Law { return UnsplitFibres<ConstantTension>{{positive(f, "tension_Pa")}}; }},
      {"calcium_tension", [](JsonObject& f) -> Law { return UnsplitFibres<CalciumTension>{calcium_tension(f)}; }},
      {"isotropic_tension", [](JsonObject& f) -> Law { return IsotropicTension{positive(f, "tension_Pa")}; }},
  };
  return kLaws;
}

Law read_law(const JsonValue& name, JsonObject& parameters) {
  std::vector<std::string> names;
  for (const NamedLaw& law : known_laws()) names.emplace_back(law.name);
  const std::string chosen = name.one_of(names);
  const auto place = std::find(names.begin(), names.end(), chosen) - names.begin();
  return known_laws()[static_cast<std::size_t>(place)].read(parameters);
}

template <class T>
constexpr bool kIsMatrix = std::is_same_v<T, StableNeoHookean> || std::is_same_v<T, NeoHookean> ||
                           std::is_same_v<T, MooneyRivlin> || std::is_same_v<T, Corotated>;
template <class T>
constexpr bool kIsWholeMuscle =
    std::is_same_v<T, BlemkerMuscle<BlemkerFibre>> || std::is_same_v<T, BlemkerMuscle<ExponentialFibre>>;

bool follows_fibre(const Law& law) {
  return std::visit([]<class T>(const T&) { return !kIsMatrix<T> && !std::is_same_v<T, IsotropicTension>; }, law);
}

bool carries_shear(const Law& law) {
  return std::visit([]<class T>(const T&) { return kIsMatrix<T> || kIsWholeMuscle<T>; }, law);
}

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
    throw value.error(
        fmt::format("tet {} of region {} has no fibre and a law needs one; give \"fibre\" a direction, or "
                    "the mesh {} unit cell vectors \"fibre\"",
                    tet, out.mesh.regions[tet], out.mesh.file));
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

double default_fluctuation_Pa(const std::vector<Law>& laws) {
  double shear_Pa = 0.0;
  double volume_Pa = 0.0;
  for (const Law& law : laws) {
    std::visit(
        [&]<class T>(const T& matrix) {
          if constexpr (std::is_same_v<T, MooneyRivlin>) shear_Pa += 2.0 * (matrix.c1_Pa + matrix.c2_Pa);
          if constexpr (kIsWholeMuscle<T>) shear_Pa += std::min(matrix.along_Pa, matrix.across_Pa);
          if constexpr (requires { matrix.shear_Pa; }) shear_Pa += matrix.shear_Pa;
          if constexpr (kIsMatrix<T> || kIsWholeMuscle<T>)
            volume_Pa += matrix.template volume<double>(1.0).curvature_Pa;
        },
        law);
  }
  return std::clamp(4.0 * shear_Pa, 0.0, std::max(volume_Pa, 0.0));
}

}  // namespace myotact::measure
