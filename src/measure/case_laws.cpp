#include "measure/case_laws.h"

#include <algorithm>
#include <string>
#include <type_traits>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::measure {

namespace {

using namespace simulation;

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

/// Either shear_Pa and lambda_Pa, or young_Pa and poisson.
LameModuli read_lame(JsonObject& fields) {
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
    return lame_moduli(young_Pa, nu);
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
  const LameModuli lame = read_lame(fields);
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

template <class T>
constexpr bool kIsMatrix = std::is_same_v<T, StableNeoHookean> || std::is_same_v<T, NeoHookean> ||
                           std::is_same_v<T, MooneyRivlin> || std::is_same_v<T, Corotated>;
template <class T>
constexpr bool kIsWholeMuscle =
    std::is_same_v<T, BlemkerMuscle<BlemkerFibre>> || std::is_same_v<T, BlemkerMuscle<ExponentialFibre>>;

}  // namespace

LameModuli lame_moduli(double young_Pa, double poisson) {
  return {young_Pa / (2.0 * (1.0 + poisson)), young_Pa * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))};
}

Law read_law(const JsonValue& name, JsonObject& parameters) {
  std::vector<std::string> names;
  for (const NamedLaw& law : known_laws()) names.emplace_back(law.name);
  const std::string chosen = name.one_of(names);
  const auto place = std::find(names.begin(), names.end(), chosen) - names.begin();
  return known_laws()[static_cast<std::size_t>(place)].read(parameters);
}

bool follows_fibre(const Law& law) {
  return std::visit([]<class T>(const T&) { return !kIsMatrix<T> && !std::is_same_v<T, IsotropicTension>; }, law);
}

bool carries_shear(const Law& law) {
  return std::visit([]<class T>(const T&) { return kIsMatrix<T> || kIsWholeMuscle<T>; }, law);
}

double shear_at_rest_Pa(const Law& law) {
  return std::visit(
      []<class T>(const T& matrix) {
        if constexpr (std::is_same_v<T, MooneyRivlin>) return 2.0 * (matrix.c1_Pa + matrix.c2_Pa);
        if constexpr (kIsWholeMuscle<T>) return std::min(matrix.along_Pa, matrix.across_Pa);
        if constexpr (requires { matrix.shear_Pa; }) return matrix.shear_Pa;
        return 0.0;
      },
      law);
}

double default_fluctuation_Pa(const std::vector<Law>& laws) {
  double shear_Pa = 0.0;
  double volume_Pa = 0.0;
  for (const Law& law : laws) {
    shear_Pa += shear_at_rest_Pa(law);
    std::visit(
        [&]<class T>(const T& matrix) {
          if constexpr (kIsMatrix<T> || kIsWholeMuscle<T>)
            volume_Pa += matrix.template volume<double>(1.0).curvature_Pa;
        },
        law);
  }
  return std::clamp(4.0 * shear_Pa, 0.0, std::max(volume_Pa, 0.0));
}

}  // namespace myotact::measure
