#pragma once

#include "messages/scene_frame.h"
#include "messages/tool_state.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// The scene's tool of that index as the view draws it: with the bone's point in hand where it is now.
messages::ToolFrame tool_frame(const messages::ToolState& tool, const Scene& scene, std::size_t index,
                               const simulation::Simulation& simulation);

}  // namespace myotact::scene
