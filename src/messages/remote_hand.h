#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "messages/tool_state.h"

namespace myotact::messages {

/// What the simulation's springs did to a hand at the end of a step.
struct HandForce {
  std::uint64_t step = 0;  // counted from 1
  std::array<double, 3> force_world_N{};
};

/// The same state of a hand that touches and holds nothing and does not move.
inline ToolState let_go(ToolState state) noexcept {
  state.sequence = 0;
  state.contact = {};
  state.beside = {};
  state.touched_world_m = {};
  state.force_world_N = {};
  state.buttons = 0;
  state.grabbed_line = -1;
  state.grabbed_body = -1;
  state.line_stiffness_N_m = 0.0;
  state.body_stiffness_N_m = 0.0;
  return state;
}

static_assert(std::is_trivially_copyable_v<HandForce>);

}  // namespace myotact::messages
