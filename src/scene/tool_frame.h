#pragma once

#include "messages/felt_tool.h"
#include "messages/scene_frame.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// The scene's tool of that index as the view draws it: with the bone's point in hand where it is now.
messages::ToolFrame tool_frame(const messages::FeltTool& felt, const Scene& scene, std::size_t index,
                               const simulation::Simulation& simulation);

}  // namespace myotact::scene
