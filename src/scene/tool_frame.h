#pragma once

#include "messages/scene_frame.h"
#include "messages/tool_state.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// The tool as the view draws it: with the bone's point in hand where it is now.
messages::ToolFrame tool_frame(const messages::ToolState& tool, double radius_m,
                               const simulation::Simulation& simulation);

}  // namespace myotact::scene
