#pragma once

#include <cstdint>

#include "core/vector.h"
#include "haptics/proxy/moving_surface.h"
#include "haptics/proxy/proxy.h"

namespace myotact::haptics {

/// What a method of touch answers in a tick. World frame, before the force scale.
struct TouchTick {
  Vec3 force_N = Vec3::Zero();             // on the hand
  double stiffness_N_m = 0.0;              // of the spring between hand and tissue; 0: no contact
  Vec3 end_m = Vec3::Zero();               // its far end: where the tissue would be without the tool
  Vec3 end_moved_m = Vec3::Zero();         // by itself, in this tick
  const MovingSurface* surface = nullptr;  // of the contact's triangle; the method owns it
  ProxyContact contact;                    // inactive for methods that know no surface
  std::uint32_t faults = 0;                // bits of Fault
};

}  // namespace myotact::haptics
