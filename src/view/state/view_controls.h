#pragma once

#include <array>
#include <cstdint>

namespace myotact::view {

/// What the person at the window holds and moves, as of this picture: the newest counts. What is asked for once goes by
/// SceneControls. The window knows neither simulation nor device.
struct ViewControls {
  double replay_to_s = 0.0;  // of a recording: how far it is to be simulated
  bool hand_moves = false;   // the mouse is the hand now
  std::array<double, 3> hand_world_m{};
  std::uint32_t hand_buttons = 0;
  bool clutch = false;  // held: hands on devices move, their tools stay
  /// The picture's right, up and towards the person, each of length 1; zero: there is no picture yet.
  std::array<std::array<double, 3>, 3> view_axes_world{};
};

}  // namespace myotact::view
