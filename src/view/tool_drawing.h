#pragma once

#include <glm/glm.hpp>

#include "messages/scene_frame.h"
#include "view/drawable.h"

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
/// Shafts lean away from `middle_m`, the middle of the specimen: devices tell no direction.
void add_tool(DrawMesh& mesh, const messages::ToolFrame& tool, const glm::vec3& middle_m);

}  // namespace myotact::view
