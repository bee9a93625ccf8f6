#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "anatomy/specimen.h"

namespace myotact::view {

/// A short stroke on a skin, along the fibres of the tet below: two places in the plane of one triangle, as shares of
/// its corners (which may lie outside 0 .. 1: a stroke may be longer than its triangle).
struct FibreStroke {
  int triangle = 0;
  std::array<glm::vec3, 2> shares{};
};

/// Strokes spread evenly over a muscle's skin; where the fibres run into the skin there are none. Same each time.
std::vector<FibreStroke> fibre_strokes(const anatomy::Muscle& muscle);

}  // namespace myotact::view
