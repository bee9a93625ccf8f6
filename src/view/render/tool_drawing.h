#pragma once

#include <glm/glm.hpp>

#include "messages/scene_frame.h"
#include "view/render/drawable.h"

namespace myotact::view {

/// Length of the force arrow.
inline constexpr float kArrowLength_m_N = 0.02f;

/// Each hand has its own colour: right green, left blue.
glm::vec3 tool_colour(const messages::ToolFrame& tool);

/// Appends a tool, what it holds and its force arrow:
///
///   ball   the sphere that is felt, beside it, darker, where the device is
///   point  a cone whose tip is the sphere that is felt
///   clamp  two jaws round the sphere that is felt
///
/// Shafts lean away from `middle_m`, the middle of the specimen: devices report no direction.
void add_tool(DrawMesh& mesh, const messages::ToolFrame& tool, const glm::vec3& middle_m);

/// What joins hand and tool.
inline constexpr glm::vec4 kThread{0.10f, 0.10f, 0.12f, 0.55f};

/// For a hand that feels nothing: the tool is held back, by the surface or by the muscle line in hand, and the hand
/// goes on. Appends that tool, and a thread from it to the hand that is the longer the stronger the force.
void add_tool_held_back(DrawMesh& mesh, const messages::ToolFrame& tool, const messages::SceneFrame& frame,
                        const glm::vec3& middle_m);

}  // namespace myotact::view
