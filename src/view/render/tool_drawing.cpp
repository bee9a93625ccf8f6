#include "view/render/tool_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "view/look/posing.h"

namespace myotact::view {

namespace {

// Okabe-Ito, which the colour-blind can distinguish.
constexpr glm::vec3 kRight{0.00f, 0.62f, 0.45f}, kLeft{0.00f, 0.45f, 0.70f};
constexpr glm::vec4 kRightForce{0.84f, 0.37f, 0.00f, 1.0f}, kLeftForce{0.80f, 0.47f, 0.65f, 1.0f};
constexpr glm::vec4 kGrip{0.80f, 0.18f, 0.12f, 1.0f};
constexpr float kRod_m = 0.9e-3f;                                 // radius of what joins hand and grip
constexpr float kThread_m = 0.5e-3f;                              // radius of what joins hand and tool
constexpr float kGrip_N_m = 300.0f;                               // grab_stiffness_N_m of haptics/muscle_line_drag
constexpr float kConeLength_m = 0.035f, kConeRadius_m = 3.5e-3f;  // of a stylus
constexpr float kJawLength_m = 0.018f, kShaftLength_m = 0.045f;   // of a clamp
constexpr float kThinnestArrow_m = 0.9e-3f, kJawRadius_m = 1.4e-3f;

/// Unit vector along the shaft, out of the limb and a little up, as a hand holds it.
glm::vec3 shaft_axis(const glm::vec3& tip_m, const glm::vec3& middle_m) {
  const glm::vec3 out(tip_m.x - middle_m.x, tip_m.y - middle_m.y, 0.0f);
  const float length = glm::length(out);
  return glm::normalize((length > 1e-4f ? out / length : glm::vec3(0, 1, 0)) + glm::vec3(0, 0, 0.6f));
}

void add_clamp(DrawMesh& mesh, const glm::vec3& tip_m, const glm::vec3& axis, float radius_m, const glm::vec4& colour) {
  const glm::vec3 side = glm::normalize(glm::cross(axis, glm::vec3(0, 0, 1)));
  const glm::vec3 hinge = tip_m + kJawLength_m * axis;
  for (const float sign : {-1.0f, 1.0f}) {
    const glm::vec3 tooth = tip_m + sign * radius_m * side;
    const glm::vec3 elbow = tooth + 0.5f * kJawLength_m * axis + 0.5f * sign * radius_m * side;
    add_sphere(mesh, tooth, kJawRadius_m, colour);
    add_tube(mesh, tooth, elbow, kJawRadius_m, colour);
    add_sphere(mesh, elbow, kJawRadius_m, colour);
    add_tube(mesh, elbow, hinge, kJawRadius_m, colour);
  }
  add_sphere(mesh, hinge, 2.0f * kJawRadius_m, colour);
  add_tube(mesh, hinge, hinge + kShaftLength_m * axis, 1.5f * kJawRadius_m, colour);
}

void add_body(DrawMesh& mesh, const messages::ToolFrame& tool, const glm::vec3& middle_m) {
  const glm::vec3 tip_m = to_glm(tool.proxy_world_m);
  const glm::vec3 axis = shaft_axis(tip_m, middle_m);
  const glm::vec4 colour(tool_colour(tool), 1.0f);
  const auto radius_m = static_cast<float>(tool.radius_m);
  if (tool.shape == messages::ToolShape::Clamp) {
    // What it holds is between its jaws, wherever the hand has been pulled to.
    const glm::vec3 held_m = tool.grabbed_body >= 0 ? to_glm(tool.grip_world_m) : tip_m;
    add_clamp(mesh, held_m, axis, radius_m, colour);
    return;
  }
  add_sphere(mesh, tip_m, radius_m, colour);
  if (tool.shape == messages::ToolShape::Point) {
    const glm::vec3 neck_m = tip_m + kConeLength_m * axis;
    add_cone(mesh, neck_m, tip_m, {kConeRadius_m, radius_m}, colour);
    add_tube(mesh, neck_m, neck_m + kConeLength_m * axis, kConeRadius_m, colour);
  }
}

glm::vec3 nearest_on(const std::vector<std::array<double, 3>>& line_m, const glm::vec3& place_m) {
  glm::vec3 nearest_m = to_glm(line_m.front());
  for (std::size_t i = 0; i + 1 < line_m.size(); ++i) {
    const glm::vec3 from_m = to_glm(line_m[i]), way_m = to_glm(line_m[i + 1]) - from_m;
    const float share = glm::dot(place_m - from_m, way_m) / std::max(glm::dot(way_m, way_m), 1e-12f);
    const glm::vec3 there_m = from_m + std::clamp(share, 0.0f, 1.0f) * way_m;
    if (glm::distance(there_m, place_m) < glm::distance(nearest_m, place_m)) nearest_m = there_m;
  }
  return nearest_m;
}

/// From the hand to the tool that holds a line: as the simulated grip gives way, but no farther than the line at rest,
/// which lies `way_m` from the hand.
glm::vec3 lag_m(const messages::ToolFrame& tool, const glm::vec3& way_m) {
  const glm::vec3 force_N = to_glm(tool.parts.line) / static_cast<float>(std::max(tool.force_scale, 1e-6));
  const float length_m = glm::length(force_N) / kGrip_N_m, farthest_m = glm::length(way_m);
  return length_m > farthest_m ? way_m : force_N / kGrip_N_m;
}

}  // namespace

glm::vec3 tool_colour(const messages::ToolFrame& tool) {
  return tool.left ? kLeft : kRight;
}

void add_tool(DrawMesh& mesh, const messages::ToolFrame& tool, const glm::vec3& middle_m) {
  const glm::vec3 proxy_m = to_glm(tool.proxy_world_m), device_m = to_glm(tool.tool_world_m);
  const auto radius_m = static_cast<float>(tool.radius_m);
  add_body(mesh, tool, middle_m);
  add_sphere(mesh, device_m, 0.6f * radius_m, kThread);
  if (tool.grabbed_body >= 0) {
    const glm::vec3 grip_m = to_glm(tool.grip_world_m);
    add_sphere(mesh, grip_m, radius_m, kGrip);
    add_tube(mesh, grip_m, device_m, kRod_m, kThread);
  }
  add_arrow(mesh, proxy_m, proxy_m + kArrowLength_m_N * to_glm(tool.force_world_N),
            std::max(0.4f * radius_m, kThinnestArrow_m), tool.left ? kLeftForce : kRightForce);
}

void add_tool_held_back(DrawMesh& mesh, const messages::ToolFrame& tool, const messages::SceneFrame& frame,
                        const glm::vec3& middle_m) {
  messages::ToolFrame held = tool;
  if (const auto line = static_cast<std::size_t>(tool.grabbed_line);
      tool.grabbed_line >= 0 && line < frame.lines_world_m.size() && !frame.lines_world_m[line].empty()) {
    const glm::vec3 hand_m = to_glm(tool.tool_world_m);
    const glm::vec3 place_m = hand_m + lag_m(tool, nearest_on(frame.lines_world_m[line], hand_m) - hand_m);
    held.proxy_world_m = {double(place_m.x), double(place_m.y), double(place_m.z)};
  }
  add_tool(mesh, held, middle_m);
  add_thread(mesh, to_glm(held.proxy_world_m), to_glm(held.tool_world_m), kThread_m, kThread);
}

}  // namespace myotact::view
