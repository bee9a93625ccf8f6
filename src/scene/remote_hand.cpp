#include "scene/remote_hand.h"

#include <algorithm>

#include "core/vector.h"

namespace myotact::scene {

namespace {

/// Of the line in hand, pulled to a corner at the hand.
Vec3 line_force_N(const messages::LocalLine& line, const Vec3& hand_m) {
  Vec3 force_N = Vec3::Zero();
  for (const auto& end : {line.proximal_point_world_m, line.distal_point_world_m}) {
    const Vec3 way_m = to_vec3(end) - hand_m;
    if (way_m.norm() > 0.0) force_N += line.tension_N / way_m.norm() * way_m;
  }
  return force_N;
}

bool is_below(std::int32_t index, std::size_t count) {
  return index < 0 || static_cast<std::size_t>(index) < count;
}

}  // namespace

messages::ToolState heeded(const messages::ToolState& received, const anatomy::Specimen& specimen) {
  const std::size_t surfaces = specimen.muscles.size() + specimen.bones.size();
  const bool fits = is_below(received.contact.surface, surfaces) &&
                    std::all_of(received.beside.begin(), received.beside.end(),
                                [&](const messages::ToolContact& c) { return is_below(c.surface, surfaces); }) &&
                    is_below(received.grabbed_line, specimen.muscles.size()) &&
                    is_below(received.grabbed_body, specimen.bodies.size());
  return fits && received.sequence > 0 ? received : messages::let_go(received);
}

std::array<double, 3> force_on_hand_N(const messages::LocalModel& model, const messages::ToolState& tool) {
  if (tool.sequence == 0) return {};
  const Vec3 hand_m = to_vec3(tool.tool_position_world_m);
  Vec3 force_N = model.tether.stiffness_N_m * (to_vec3(model.tether.anchor_world_m) - hand_m);
  if (tool.contact.stiffness_N_m > 0.0) force_N -= to_vec3(model.contact.force_world_N);
  if (tool.grabbed_body >= 0) force_N -= to_vec3(model.grip.force_world_N);
  if (tool.grabbed_line >= 0 && model.line.muscle == tool.grabbed_line) force_N += line_force_N(model.line, hand_m);
  return to_array(force_N);
}

}  // namespace myotact::scene
