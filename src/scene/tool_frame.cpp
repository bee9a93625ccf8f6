#include "scene/tool_frame.h"

namespace myotact::scene {

messages::ToolFrame tool_frame(const messages::ToolState& tool, double radius_m,
                               const simulation::Simulation& simulation) {
  messages::ToolFrame frame{tool.tool_position_world_m, tool.proxy_position_world_m, tool.force_world_N, radius_m,
                            tool.contact.surface >= 0,  tool.grabbed_line,           tool.grabbed_body,  {}};
  if (tool.grabbed_body >= 0) {
    frame.grip_world_m = to_array(simulation.body_pose(tool.grabbed_body) * to_vec3(tool.body_point_rest_m));
  }
  return frame;
}

}  // namespace myotact::scene
