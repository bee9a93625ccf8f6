#pragma once

#include <array>

#include <glm/glm.hpp>

namespace myotact::view {

/// The map cividis (Nunez, Anderton and Renslow 2018), readable with any colour vision; 0 dark blue .. 1 yellow.
glm::vec3 cividis(double level);

/// From the red of a muscle at rest, 0, through orange to yellow, 1. Its lightness rises evenly (CIELAB L* 38 .. 91):
/// readable with any colour vision, and by lightness alone.
glm::vec3 red_yellow(double level);
/// Its colours at evenly spaced levels from 0 to 1; between them it is linear.
std::array<glm::vec3, 10> red_yellow_table();

/// For signed values: -1 blue .. 0 near white .. 1 orange, lightest in the middle, distinguishable with any colour
/// vision.
glm::vec3 blue_orange(double level);

}  // namespace myotact::view
