#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "messages/scene_frame.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::app {

/// Draws the scene as it is now from a standard view. Without any OpenGL it warns and goes on without a picture; throws
/// Error InputOutput when the file cannot be written.
void write_picture(const scene::Scene& scene, const simulation::Simulation& simulation,
                   const std::vector<messages::ToolFrame>& tools, const std::string& view,
                   const std::filesystem::path& path);

}  // namespace myotact::app
