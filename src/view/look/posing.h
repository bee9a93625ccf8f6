#pragma once

#include <array>
#include <cstddef>

#include <glm/glm.hpp>

#include "anatomy/specimen.h"
#include "core/vector.h"
#include "messages/scene_frame.h"

// From the types of the frame and the specimen to those of drawing.

namespace myotact::view {

inline glm::vec3 to_glm(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

inline glm::vec3 to_glm(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

inline glm::vec3 to_glm(const std::array<float, 3>& v) {
  return {v[0], v[1], v[2]};
}

/// A pose, row-major 3x4, as a matrix.
inline glm::mat4 to_glm(const std::array<double, 12>& pose) {
  glm::mat4 matrix(1.0f);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      matrix[column][row] =
          static_cast<float>(pose[4 * static_cast<std::size_t>(row) + static_cast<std::size_t>(column)]);
    }
  }
  return matrix;
}

/// Where a bone is in this frame; at its file pose when the frame has no pose for its body.
inline glm::mat4 pose_of_bone(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, std::size_t bone) {
  const auto body = static_cast<std::size_t>(specimen.bones[bone].body);
  return body < frame.body_poses.size() ? to_glm(frame.body_poses[body]) : glm::mat4(1.0f);
}

}  // namespace myotact::view
