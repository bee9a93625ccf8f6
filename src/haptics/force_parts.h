#pragma once

#include "core/vector.h"
#include "haptics/effects/effects.h"
#include "messages/scene_frame.h"

namespace myotact::haptics {

/// The forces on the hand of one tick, from what was wanted to what was sent [N, world, felt].
struct TickForces {
  EffectTicks wanted{};
  Vec3 passed_lines_N = Vec3::Zero();  // of the wanted texture: lines that an open hand passes over
  Vec3 contact_normal = Vec3::Zero();  // unit, out of the tissue; zero: none
  Vec3 ports_change_N = Vec3::Zero();  // what the ports added
  Vec3 gate_damping_N = Vec3::Zero();  // and what the gate's passivity did
  Vec3 sent_N = Vec3::Zero();
};

/// The sent force in parts that add up to it. What is not a number appears in no part. Real-time safe; any thread.
messages::ForceParts force_parts(const TickForces& tick) noexcept;

}  // namespace myotact::haptics
