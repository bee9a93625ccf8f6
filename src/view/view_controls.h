#pragma once

#include <array>
#include <cstdint>

#include "view/scene_state.h"

namespace myotact::view {

/// What the person at the window asks for, as of this picture. The window knows neither simulation nor device.
struct ViewControls {
  SceneState scene;
  bool paused = false;
  std::uint32_t stops = 0;           // emergency stops asked for so far
  std::uint32_t arms = 0;            // times that forces were enabled again
  std::uint32_t steps = 0;           // single steps asked for so far
  std::uint32_t resets = 0;          // resets asked for so far
  std::uint32_t shoves = 0;          // shove tests asked for so far
  std::uint32_t recording_ends = 0;  // times that a recording was to end
  double replay_to_s = 0.0;          // of a recording: how far it is to be simulated
  bool hand_moves = false;           // the mouse is the hand now
  std::array<double, 3> hand_world_m{};
  std::uint32_t hand_buttons = 0;
  bool clutch = false;  // held: hands on devices move, their tools stay
  /// The picture's right, up and towards the person, each of length 1; zero: there is no picture yet.
  std::array<std::array<double, 3>, 3> view_axes_world{};
};

}  // namespace myotact::view
