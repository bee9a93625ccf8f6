#pragma once

#include <vector>

#include "view/look/camera.h"
#include "view/look/part.h"

namespace myotact::view {

/// Opacity of a faded part, of what it would be else.
inline constexpr float kFadedShare = 0.28f;
/// Below this a part is looked and clicked through.
inline constexpr float kSolidOpacity = 0.5f;

/// Opacity of a part, 0 (not drawn) .. 1, from its look and its layer. `superficial`: muscles of the superficial layer,
/// as in the specimen; the others are deep.
float opacity_of(const ViewState& view, const std::vector<bool>& superficial, const Part& part);

/// The plane of a section as n, d: kept is where dot(n, p) + d >= 0, with p in the world. Keeps everything when off.
glm::vec4 kept_half_space(const SectionPlane& section, const ViewBox& limb);

inline bool is_kept(const glm::vec4& half_space, const glm::vec3& p_world_m) {
  return glm::dot(half_space, glm::vec4(p_world_m, 1.0f)) >= 0.0f;
}

}  // namespace myotact::view
