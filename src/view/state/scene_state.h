#pragma once

#include <array>
#include <optional>

#include "messages/control_state.h"

namespace myotact::view {

using messages::Drive;

/// What a person sets of the scene, a value like ViewState: undo goes back to an earlier one, two of them can be stored
/// and compared.
struct SceneState {
  Drive drive = Drive::Script;
  double flexors = 0.0, extensors = 0.0;  // Levels, 0 .. 1
  double common = 0.0;                    // Balance, 0 .. 1
  double difference = 0.0;                // Balance, -1 .. 1
  bool hold_posture = false;
  bool gravity = false;
  messages::ChosenTools tools{};  // of the scene, in its order; none: as the scene says

  bool operator==(const SceneState&) const = default;
};

/// A and B, which a person feels in turn; empty: not kept.
using KeptStates = std::array<std::optional<SceneState>, 2>;

}  // namespace myotact::view
