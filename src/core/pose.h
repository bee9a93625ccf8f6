#pragma once

#include "core/vector.h"

namespace myotact {

/// Rigid motion. X_WB maps coordinates in B to coordinates in W: p_W = R_WB p_B + p_WB.
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation_m = Vec3::Zero();

  Vec3 operator*(const Vec3& point_m) const { return rotation * point_m + translation_m; }
  Pose operator*(const Pose& inner) const {
    return {rotation * inner.rotation, rotation * inner.translation_m + translation_m};
  }
  Pose inverse() const {
    const Mat3 transposed = rotation.transpose();
    return {transposed, -(transposed * translation_m)};
  }
};

}  // namespace myotact
