#pragma once

#include <cstdint>

#include "core/vector.h"
#include "haptics/gate/energy_port.h"
#include "haptics/proxy/moving_surface.h"
#include "haptics/proxy/proxy.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// What every effect is given in a tick. World frame; valid during the tick alone.
struct HandTick {
  ProxyGoal hand;                               // the device's place and velocity, finite
  std::uint32_t buttons = 0;                    // messages::k...Button, as the tool's shape means them
  const messages::LocalModel* model = nullptr;  // newest sound one, null: none
  bool is_new = false;                          // it is not the model of the last tick
  double model_age_s = 0.0;                     // of the state that it shows
  std::uint64_t now_ns = 0;                     // the caller's clock, as in LocalModel::published_at_ns
  double dt_s = 1e-3;                           // > 0
  std::uint64_t sequence = 0;                   // of the ToolState that this tick will write
  double limit_N = 0.0;                         // the most that the gate sends in this tick
  double sent_N = 0.0;                          // size of what it sent in the last one
};

/// What an effect answers in a tick.
struct EffectTick {
  Vec3 force_N = Vec3::Zero();  // on the hand, felt: after the force scale; world
  PortTick port;             // what its observer of energy must know; wanted_N, the hand's part and dt_s are filled in
  std::uint32_t faults = 0;  // bits of Fault
};

/// What the touch is in this tick, for effects on the tissue.
struct Touch {
  const MovingSurface* surface = nullptr;  // of the contact's triangle; never null once ContactEffect ticked
  ProxyContact contact;                    // of the proxy; reported contacts leave it inactive
  Vec3 force_N = Vec3::Zero();             // on the hand, before the force scale; world
  Vec3 tissue_moved_m = Vec3::Zero();      // under the tool, in this tick; world
  bool presses = false;                    // its spring is stretched or may be
};

/// What effects pass to each other. It outlives the tick: an effect finds what those before it (effects.h) wrote in
/// this tick, and what those after it wrote in the last one.
struct EffectNotes {
  bool holds_bone = false;             // BoneEffect: in hand or just let go
  double bone_gain = 0.0;              // how far the hand has closed on it, 0 .. 1
  Touch touch;                         // ContactEffect
  Vec3 passed_lines_N = Vec3::Zero();  // TextureEffect: of its force, what muscle lines under an open hand do
  double line_gain = 0.0;              // LineEffect: how far the hand has closed on a line, 0 .. 1
  double line_tension_N = 0.0;         // of the line in hand, unscaled; 0: none
};

/// Energy of a spring of stiffness `stiffness_N_m` that is stretched by `stretch_m` and gives `force_N` [J], felt;
/// beyond F / k its force was cut, and comes back over that way as it went. 0 without stiffness. Real-time safe.
double spring_energy_J(double force_N, double stiffness_N_m, double stretch_m) noexcept;

}  // namespace myotact::haptics
