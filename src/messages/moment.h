#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "messages/control_state.h"

namespace myotact::messages {

/// What a scene can be set back to of a moment of its past: posture, activations, and what was in force. Of the
/// tissue's motion, the hand's and the script's place nothing is in it. Bounded, to cross threads by value.
struct Moment {
  static constexpr std::size_t kMostJoints = 32, kMostMuscles = 128;

  std::array<double, kMostJoints> angles_rad{};   // positive flexes; as in the specimen, the first `joints` of them
  std::array<float, kMostMuscles> activations{};  // 0 .. 1; likewise
  std::uint32_t joints = 0, muscles = 0;
  ControlState control;
};
static_assert(std::is_trivially_copyable_v<Moment>);

}  // namespace myotact::messages
