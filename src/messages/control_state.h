#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "messages/held_tool.h"

namespace myotact::messages {

/// Who gives a command.
enum class Commander : std::uint8_t { Script, Window, Lesson, Network };

/// Which of the controls drives the muscles of a co-contraction.
enum class Drive : std::uint8_t { Script, Levels, Balance };

/// A person has two hands.
inline constexpr std::size_t kMostChosenTools = 2;

/// What somebody chose of the tools of a scene, in its order; none: as the scene says.
using ChosenTools = std::array<std::optional<ToolShape>, kMostChosenTools>;

/// What is in force in a scene, whoever asked for it. Crosses threads and the network by value.
struct ControlState {
  Drive drive = Drive::Script;
  Commander driver = Commander::Script;  // who set the drive
  double flexors = 0.0;                  // 0 .. 1, asked for last; they lead where the drive is Levels
  double extensors = 0.0;                // 0 .. 1
  double common = 0.0;                   // 0 .. 1, asked for last; where the script drives: on its way
  double difference = 0.0;               // -1 .. 1, as common
  double common_now = 0.0;               // 0 .. 1, what both sides have in common now, whatever drives them
  bool hold_posture = false;
  bool gravity = false;
  bool paused = false;
  bool recording = false;  // a recording is being written
  ChosenTools tools{};     // asked for last; not on the wire: a ToolFrame states what is in the hand

  bool operator==(const ControlState&) const = default;
};
static_assert(std::is_trivially_copyable_v<ControlState>);

}  // namespace myotact::messages
