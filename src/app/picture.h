#pragma once

#include <filesystem>
#include <string>

#include "messages/tool_state.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::app {

/// Draws the scene as it is now from a standard view. Without any OpenGL it warns and goes on without a picture; throws
/// Error InputOutput when the file cannot be written.
void write_picture(const scene::Scene& scene, const simulation::Simulation& simulation, const messages::ToolState& tool,
                   const std::string& view, const std::filesystem::path& path);

}  // namespace myotact::app
