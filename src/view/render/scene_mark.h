#pragma once

#include <glm/glm.hpp>

namespace myotact::view {

/// A ball that points out a place of the scene; nothing hides it.
struct SceneMark {
  glm::vec3 place_world_m{0.0f};
  float radius_m = 0.001f;
  glm::vec4 colour{1.0f};
};

}  // namespace myotact::view
