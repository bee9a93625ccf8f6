#include "scene/tool_choice.h"

namespace myotact::scene {

messages::HeldTool tool_in_hand(const ToolSettings& tool, std::optional<messages::ToolShape> chosen) {
  if (!chosen || *chosen == tool.shape) return {tool.shape, tool.radius_m};
  return {*chosen, *chosen == messages::ToolShape::Point ? kPointRadius_m : ToolSettings{}.radius_m};
}

ToolSettings with_choice(ToolSettings tool, std::optional<messages::ToolShape> chosen) {
  const messages::HeldTool held = tool_in_hand(tool, chosen);
  tool.shape = held.shape;
  tool.radius_m = held.radius_m;
  return tool;
}

}  // namespace myotact::scene
