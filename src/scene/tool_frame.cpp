#include "scene/tool_frame.h"

#include "haptics/faults.h"

namespace myotact::scene {

messages::ToolFrame tool_frame(const messages::FeltTool& felt, const Scene& scene, std::size_t index,
                               const simulation::Simulation& simulation) {
  const messages::ToolState& tool = felt.tool;
  const ToolSettings& settings = scene.tools[index];
  messages::ToolFrame frame;
  frame.hand = static_cast<int>(index);
  frame.tool_world_m = tool.tool_position_world_m;
  frame.proxy_world_m = tool.proxy_position_world_m;
  frame.force_world_N = tool.force_world_N;
  frame.radius_m = felt.held.radius_m;
  frame.shape = felt.held.shape;
  frame.left = settings.hand == "left";
  frame.in_contact = tool.contact.surface >= 0;
  const int bone = tool.contact.surface - simulation.muscle_count();  // surfaces: muscles, then bones
  if (bone < 0) frame.touched_muscle = tool.contact.surface;
  if (bone >= 0) frame.touched_body = scene.specimen.bones[static_cast<std::size_t>(bone)].body;
  frame.forces_stopped = (tool.faults & haptics::bit(haptics::Fault::Stopped)) != 0;
  frame.grabbed_line = tool.grabbed_line;
  frame.grabbed_body = tool.grabbed_body;
  if (tool.grabbed_body >= 0) {
    frame.grip_world_m = to_array(simulation.body_pose(tool.grabbed_body) * to_vec3(tool.body_point_rest_m));
  }
  frame.parts = felt.parts;
  frame.line_tension_N = felt.line_tension_N;
  frame.force_scale = settings.force_scale;
  frame.model_age_s = felt.model_age_s;
  return frame;
}

}  // namespace myotact::scene
