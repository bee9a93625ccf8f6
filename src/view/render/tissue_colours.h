#pragma once

#include <glm/glm.hpp>

namespace myotact::view {

// What is under the tints: fresh muscle, tendon and bone, as in a preparation and not as in wax. As on a screen (sRGB).
inline constexpr glm::vec3 kTendonColour{0.89f, 0.85f, 0.77f}, kBoneColour{0.92f, 0.87f, 0.76f};

/// Of a muscle's belly. They differ a little in brightness, or neighbours would run into one another.
glm::vec3 belly_colour(int muscle);

}  // namespace myotact::view
