#pragma once

#include <optional>

#include "messages/held_tool.h"
#include "scene/scene_file.h"

namespace myotact::scene {

/// Of a point whose scene does not say how fine it is: the tip of a stylus.
inline constexpr double kPointRadius_m = 0.5e-3;

/// The scene's tool, or the one that somebody chose in its place: as large as the scene says where it is that one, else
/// as a tool of its shape is that no scene says anything of.
messages::HeldTool tool_in_hand(const ToolSettings& tool, std::optional<messages::ToolShape> chosen);

/// The settings of the scene's tool with that one in its place.
ToolSettings with_choice(ToolSettings tool, std::optional<messages::ToolShape> chosen);

}  // namespace myotact::scene
