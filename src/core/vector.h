#pragma once

#include <array>

#include <Eigen/Core>

namespace myotact {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Boundary structs carry plain arrays, because Eigen's types are not trivially copyable.
inline Vec3 to_vec3(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}
inline std::array<double, 3> to_array(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace myotact
