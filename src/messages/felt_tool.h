#pragma once

#include <type_traits>

#include "messages/held_tool.h"
#include "messages/scene_frame.h"
#include "messages/tool_state.h"

namespace myotact::messages {

/// What the haptic loop hands to the drawing of a tool, newest wins, whether the simulation steps or is paused.
struct FeltTool {
  ToolState tool;
  ForceParts parts;             // they add up to tool.force_world_N
  double line_tension_N = 0.0;  // of the line in hand, 0: none
  double model_age_s = 0.0;     // of the state that the hand feels; 0: no model yet
  HeldTool held;                // by which it is felt
};

static_assert(std::is_trivially_copyable_v<FeltTool>);

}  // namespace myotact::messages
