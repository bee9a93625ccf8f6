#include "measure/validation/fibre_kinds.h"

#include "measure/validation/step_count.h"
#include "simulation/curves/curve_set.h"
#include "simulation/muscle/activation.h"

namespace myotact::measure {
namespace {

const simulation::ForceCurves& read_curves(JsonObject& inputs) {
  const std::string name = inputs.at("curve_set").one_of(simulation::curve_set_names());
  return simulation::force_curves(*simulation::find_curve_set(name));
}

double read_activation(JsonObject& inputs) {
  const auto found = inputs.find("activation");
  return found ? found->number_between(0.0, 1.0) : 1.0;
}

std::vector<double> numbers_or_none(JsonObject& inputs, const std::string& key) {
  std::vector<double> numbers;
  const auto found = inputs.find(key);
  if (!found) return numbers;
  for (const JsonValue& element : found->elements()) numbers.push_back(element.number());
  return numbers;
}

}  // namespace

Quantities force_curve_values(JsonObject& inputs) {
  const simulation::ForceCurves& curves = read_curves(inputs);
  const double activation = read_activation(inputs);
  Quantities quantities;
  for (const double n : numbers_or_none(inputs, "lengths")) {
    quantities[quantity_at("active", n)] = curves.active.value(n);
    quantities[quantity_at("active_slope", n)] = curves.active.slope(n);
    quantities[quantity_at("passive", n)] = curves.passive.value(n);
    quantities[quantity_at("passive_slope", n)] = curves.passive.slope(n);
  }
  for (const double v : numbers_or_none(inputs, "speeds")) {
    quantities[quantity_at("force_velocity", v)] = curves.velocity.value(v, activation);
    quantities[quantity_at("force_velocity_slope", v)] = curves.velocity.slope(v, activation);
  }
  for (const double strain : numbers_or_none(inputs, "tendon_strains")) {
    quantities[quantity_at("tendon", strain)] = curves.tendon.value(1.0 + strain);
  }
  return quantities;
}

Quantities isotonic_velocity(JsonObject& inputs) {
  const simulation::ForceCurves& curves = read_curves(inputs);
  const double activation = read_activation(inputs);
  Quantities quantities;
  for (const JsonValue& load : inputs.at("loads").elements()) {
    quantities[quantity_at("shortening", load.number())] = -curves.velocity.inverse(load.number(), activation);
  }
  return quantities;
}

Quantities activation(JsonObject& inputs) {
  const double start = inputs.at("activation").number_between(0.0, 1.0);
  const double excitation = inputs.at("excitation").number_between(0.0, 1.0);
  const simulation::ActivationTimes times{inputs.at("activation_tau_s").number_between(1e-4, 1e2),
                                          inputs.at("deactivation_tau_s").number_between(1e-4, 1e2)};
  const double dt_s = inputs.at("dt_s").number_between(1e-6, 1.0);
  Quantities quantities;
  for (const JsonValue& time : inputs.at("times_s").elements()) {
    double level = start;
    const int steps = step_count(time, dt_s);
    for (int i = 0; i < steps; ++i) level = simulation::step_activation(level, excitation, times, dt_s);
    quantities[quantity_at("activation", time.number())] = level;
  }
  return quantities;
}

}  // namespace myotact::measure
