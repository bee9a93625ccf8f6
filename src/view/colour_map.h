#pragma once

#include <glm/glm.hpp>

namespace myotact::view {

/// The map cividis (Nunez, Anderton and Renslow 2018), readable with any colour vision; 0 dark blue .. 1 yellow.
glm::vec3 cividis(double level);

}  // namespace myotact::view
