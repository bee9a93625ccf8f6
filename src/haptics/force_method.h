#pragma once

#include <cstdint>

namespace myotact::haptics {

/// How the force on the hand comes about. Proxy is this project's own; the others are the published ways of giving a
/// 60 Hz engine a 1 kHz hand (A to C of Choi et al. 2011), as published, flaws included, so that they can be compared
/// with it.
enum class ForceMethod : std::int32_t {
  Proxy,  // a sphere kept outside of the surface (proxy/); bones in hand move between models (effects/bone_drag.h)
  Penetration,  // A: reported depth, carried on by the tool's motion, in place of the proxy
  Plane,        // B: plane through the reported point, in place of the proxy
  Pulling,      // C: spring to the reported place of the body in hand, in place of BoneDrag; touch is the proxy's
};

}  // namespace myotact::haptics
