#pragma once

#include "core/vector.h"

namespace myotact::anatomy {

/// No limb is larger; what lies farther out was probably written in millimetres.
inline constexpr double kFarthest_m = 10.0;

inline bool is_near(const Vec3& position_m) {
  return position_m.allFinite() && position_m.norm() <= kFarthest_m;
}

}  // namespace myotact::anatomy
