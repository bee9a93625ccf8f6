#include "scene/muscle_settings.h"

#include <nlohmann/json.hpp>

#include "anatomy/mechanics_defects.h"
#include "scene/script.h"

namespace myotact::scene {

namespace {

anatomy::Muscle& muscle_called(const std::string& key, const JsonValue& entry, anatomy::Specimen& specimen) {
  const nlohmann::json name(key);
  const int index = require_muscle(JsonValue(name, entry.file(), entry.pointer()), specimen);
  return specimen.muscles[static_cast<std::size_t>(index)];
}

void require_possible(const JsonValue& entry, const anatomy::Muscle& muscle) {
  const auto defects = anatomy::find_mechanics_defects(muscle);
  if (!defects.empty()) throw entry.error(defects.front());
}

}  // namespace

void read_muscle_settings(const JsonValue& value, anatomy::Specimen& specimen) {
  for (const auto& [key, entry] : JsonObject(value).entries()) {
    anatomy::Muscle& muscle = muscle_called(key, entry, specimen);
    JsonObject fields(entry);
    muscle.peak_force_N = fields.number_or("peak_force_N", muscle.peak_force_N);
    muscle.optimal_fibre_m = fields.number_or("optimal_fibre_m", muscle.optimal_fibre_m);
    muscle.pennation_rad = fields.number_or("pennation_rad", muscle.pennation_rad);
    muscle.rest_stretch = fields.number_or("rest_stretch", muscle.rest_stretch);
    muscle.activation_tau_s = fields.number_or("activation_tau_s", muscle.activation_tau_s);
    muscle.deactivation_tau_s = fields.number_or("deactivation_tau_s", muscle.deactivation_tau_s);
    fields.finish();
    require_possible(entry, muscle);
  }
}

void read_rest_stretches(const JsonValue& value, anatomy::Specimen& specimen) {
  for (const auto& [key, entry] : JsonObject(value).entries()) {
    anatomy::Muscle& muscle = muscle_called(key, entry, specimen);
    muscle.rest_stretch = entry.number();
    require_possible(entry, muscle);
  }
}

}  // namespace myotact::scene
