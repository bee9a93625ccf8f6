#pragma once

#include <string>

#include "measure/fidelity/scene_fidelity.h"

namespace myotact::measure {

/// A few lines for a person: the verdict, each checked figure beside its bounds, the parts, planted faults, notes. Ends
/// with a newline.
std::string scene_fidelity_text(const SceneFidelity& fidelity);

/// All of it but the time series. {"scene", "truth", "verdict", "figures", "compared", "parts", ...}; NaN is null.
std::string scene_fidelity_json(const SceneFidelity& fidelity);

/// t_s, judged, commanded_x_N.., true_x_N.., error_x_N..: one row a tick.
std::string scene_fidelity_csv(const SceneFidelity& fidelity);

/// What the truth is, in a sentence.
const char* truth_text(Truth truth);

}  // namespace myotact::measure
