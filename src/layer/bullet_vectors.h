#pragma once

#include <LinearMath/btTransform.h>

#include "core/pose.h"

namespace myotact::layer {

inline btVector3 to_bullet(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
inline Vec3 from_bullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

inline btTransform to_bullet(const Pose& pose) {
  const Mat3& r = pose.rotation;
  const btMatrix3x3 basis(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
  return btTransform(basis, to_bullet(pose.translation_m));
}
inline Pose from_bullet(const btTransform& t) {
  Pose pose;
  for (int row = 0; row < 3; ++row) pose.rotation.row(row) = from_bullet(t.getBasis().getRow(row)).transpose();
  pose.translation_m = from_bullet(t.getOrigin());
  return pose;
}

}  // namespace myotact::layer
