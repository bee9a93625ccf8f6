#pragma once

#include "anatomy/specimen.h"
#include "core/json_reader.h"

namespace myotact::scene {

/// A scene's own mechanics of muscles in place of the specimen's: {muscle: {peak_force_N, optimal_fibre_m,
/// pennation_rad, rest_stretch, activation_tau_s, deactivation_tau_s}}, each key where it is wanted. Throws Error
/// BadData for a muscle that is not there and for what a specimen could not have.
void read_muscle_settings(const JsonValue& value, anatomy::Specimen& specimen);

/// {muscle: n}: the rest stretch alone.
void read_rest_stretches(const JsonValue& value, anatomy::Specimen& specimen);

}  // namespace myotact::scene
