#pragma once

#include <cstdint>

#include "core/vector.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// A spring without rest length between the hand and an anchor, whose force ends at the most that a device may give.
struct TetherSpring {
  Vec3 anchor_m = Vec3::Zero();
  double stiffness_N_m = 0.0;  // felt; 0: no tether
  double most_N = 0.0;

  Vec3 force_N(const Vec3& hand_m) const noexcept;  // on the hand
  /// What the spring gives back on the way to its anchor [J].
  double energy_J(const Vec3& hand_m) const noexcept;
};

/// Where the anchor of the model's tether is at `now_ns`: extrapolated by its velocity for two steps at most: the place
/// of an older one is not known. Real-time safe.
Vec3 tether_anchor_m(const messages::LocalModel& model, std::uint64_t now_ns) noexcept;

}  // namespace myotact::haptics
