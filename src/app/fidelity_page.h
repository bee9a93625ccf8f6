#pragma once

#include <string>

#include "measure/fidelity/scene_fidelity.h"

namespace myotact::app {

/// One self-contained HTML page for a person: the verdict in words, every checked figure with what it means and where
/// its bounds are from, and charts (inline SVG): force and error over time, commanded against true, spectrum of the
/// jitter, stiffness that devices render.
std::string fidelity_page(const measure::SceneFidelity& fidelity);

}  // namespace myotact::app
