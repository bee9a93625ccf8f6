#pragma once

#include <cstdint>

#include "core/vector.h"
#include "messages/local_model.h"

namespace myotact::haptics {

struct LineDragSettings {
  double max_tension_N =
      2000.0;  // above any muscle of a dog's limb: a broken model stays bounded, the gate does the rest
  double grab_stiffness_N_m = 300.0;  // of the spring by which the hand holds the line in the simulation
};

/// A muscle line in hand: a string from the tool to the line's two ends, which pulls along both.
///
///      proximal o-----            F = T (u_proximal + u_distal)
///                     ---- tool   T = tension + stiffness (l - length) + damping dl/dt, 0 <= T <= max
///      distal   o-----            l = |tool - proximal| + |tool - distal|
///
/// Force rises over 100 ms after the grab and dies out over 100 ms after the release. Real-time safe; one thread.
class MuscleLineDrag {
 public:
  explicit MuscleLineDrag(const LineDragSettings& settings) : settings_(settings) {}

  struct Tool {
    Vec3 position_m = Vec3::Zero();
    Vec3 velocity_m_s = Vec3::Zero();
    bool holds = false;  // the grab button is down
  };

  /// Force on the hand [N]. `line` is the newest known: the nearest one, or the one in hand.
  Vec3 tick(const messages::LocalLine& line, const Tool& tool, double dt_s) noexcept;

  std::int32_t muscle() const noexcept { return muscle_; }  // in hand, or -1
  double fraction() const noexcept { return fraction_; }    // place on it
  double tension_N() const noexcept { return tension_N_; }  // of the string in the last tick; 0: none in hand
  double gain() const noexcept { return gain_; }            // 0 .. 1, how far the hand has closed
  double grab_stiffness_N_m() const noexcept { return settings_.grab_stiffness_N_m; }

 private:
  LineDragSettings settings_;
  messages::LocalLine line_;  // newest of the line in hand; after the release the last one
  std::int32_t muscle_ = -1;
  double fraction_ = 0.0;
  double gain_ = 0.0;
  double tension_N_ = 0.0;
  bool held_before_ = false;
};

}  // namespace myotact::haptics
