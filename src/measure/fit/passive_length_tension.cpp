#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "measure/fit/fit_kinds.h"
#include "simulation/curves/fibre_curves.h"
#include "simulation/line/hill_muscle.h"

// Force of a muscle that is not active, fibres and tendon in a row, against its length: that of hill_muscle.h, but that
// the strain of the passive curve at peak force may be sought, too, which muscles everywhere else have at 0.6.

namespace myotact::measure {

namespace {

constexpr double kLongestMuscle_m = 10.0, kCurveStrain = 0.6;

struct PassiveMuscle {
  simulation::HillMuscle hill;
  double strain = kCurveStrain;  // of the fibres beyond lo at peak force; all strains are scaled alike
};

PassiveMuscle read_passive_muscle(const JsonValue& value) {
  JsonObject fields(value);
  PassiveMuscle muscle;
  muscle.hill.peak_force_N = fields.at("peak_force_N").number_between(1e-6, 1e6);
  muscle.hill.optimal_fibre_m = fields.at("optimal_fibre_m").number_between(1e-5, kLongestMuscle_m);
  muscle.hill.pennation_rad = fields.at("pennation_rad").number_between(0.0, 1.5);
  const bool elastic = fields.at("tendon").one_of({"rigid", "elastic"}) == "elastic";
  muscle.hill.tendon = elastic ? simulation::Tendon::Elastic : simulation::Tendon::Rigid;
  muscle.hill.tendon_slack_m = fields.at("tendon_slack_m").number_between(elastic ? 1e-5 : 0.0, kLongestMuscle_m);
  if (const auto strain = fields.find("passive_strain")) muscle.strain = strain->number_between(0.05, 5.0);
  fields.finish();
  return muscle;
}

/// Of fibres that reach so far along the tendon; rises with it.
double fibre_force_N(const PassiveMuscle& muscle, double reach_m) {
  const double l = std::hypot(reach_m, simulation::fibre_width_m(muscle.hill));
  const double n = 1.0 + (l / muscle.hill.optimal_fibre_m - 1.0) * kCurveStrain / muscle.strain;
  const double cosine = l > 0.0 ? reach_m / l : 1.0;
  return muscle.hill.peak_force_N * std::max(0.0, simulation::passive_force_length(n)) * cosine;
}

double tendon_force_N(const PassiveMuscle& muscle, double length_m) {
  return muscle.hill.peak_force_N * std::max(0.0, simulation::tendon_force(length_m / muscle.hill.tendon_slack_m));
}

double passive_force_N(const PassiveMuscle& muscle, double length_m) {
  const double straight_m = length_m - muscle.hill.tendon_slack_m;
  if (!(straight_m > 0.0)) return 0.0;
  if (muscle.hill.tendon == simulation::Tendon::Rigid) return fibre_force_N(muscle, straight_m);
  double low_m = 0.0, high_m = straight_m;  // the fibres' force rises with their reach, the tendon's falls
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    const bool long_enough = fibre_force_N(muscle, middle_m) > tendon_force_N(muscle, length_m - middle_m);
    (long_enough ? high_m : low_m) = middle_m;
  }
  return fibre_force_N(muscle, 0.5 * (low_m + high_m));
}

nlohmann::json passive_model(const JsonValue& value, const std::filesystem::path& folder) {
  const auto [json, file] = model_or_file(value, folder);
  const PassiveMuscle muscle = read_passive_muscle(JsonValue(json, file));
  nlohmann::json model = json;
  model["passive_strain"] = muscle.strain;
  return model;
}

nlohmann::json passive_setting(JsonObject& fields, const nlohmann::json&, FitCurve& curve) {
  const auto length = fields.find("reference_length_m");
  const bool is_stretch = curve.x_name == "stretch";
  if (is_stretch && !length) {
    throw fields.value().error(
        "must have reference_length_m [m], the muscle's length at stretch 1: the file has the column stretch");
  }
  if (!is_stretch && length) {
    throw length->error("goes with a column stretch; leave it out, since the file has lengths");
  }
  const double reference_m = is_stretch ? length->number_between(1e-5, kLongestMuscle_m) : 1.0;
  for (double& x : curve.x) x *= reference_m;
  curve.x_name = "length_m";
  return nlohmann::json::object();
}

void predict_passive(FitProblem& problem) {
  problem.predict = [curves = problem.curves, file = problem.file](const nlohmann::json& model) {
    const PassiveMuscle muscle = read_passive_muscle(JsonValue(model, file, "/model"));
    std::vector<double> force_N;
    for (const FitCurve& curve : curves) {
      for (const double length_m : curve.x) force_N.push_back(passive_force_N(muscle, length_m));
    }
    return force_N;
  };
}

}  // namespace

FitKind passive_length_tension_kind() {
  return {"passive_length_tension",
          {"length of the muscle", {{"length_m", 1.0}, {"length_mm", 1e-3}, {"stretch", 1.0}}},
          {"force", {{"force_N", 1.0}, {"force_mN", 1e-3}}},
          passive_model,
          passive_setting,
          predict_passive};
}

}  // namespace myotact::measure
