#pragma once

#include <string>
#include <vector>

#include "measure/stiffness_sweep.h"

namespace myotact::app {

/// What stands beside a joint's stiffness that mass-spring muscles have a part in.
inline constexpr const char* kPreviewMark = "preview (mass-spring)";

/// Of the joint whose co-contraction the scene sets; it must set one.
bool is_preview(const scene::Scene& scene, const simulation::Simulation& simulation);

std::string marked_title(const std::string& title, bool preview);
/// measure::stiffness_json(), each row of a preview with a `mark`.
std::string marked_json(const std::vector<measure::StiffnessRow>& rows, bool preview);

}  // namespace myotact::app
