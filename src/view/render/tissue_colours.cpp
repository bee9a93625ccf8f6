#include "view/render/tissue_colours.h"

#include <cmath>

namespace myotact::view {

namespace {

constexpr glm::vec3 kBelly{0.62f, 0.225f, 0.18f};
constexpr float kBellyVariation = 0.08f;

}  // namespace

/// Evenly spread over the muscles, neighbours in the list far apart (golden ratio).
glm::vec3 belly_colour(int muscle) {
  const double place = 0.6180339887498949 * muscle;
  const auto share = static_cast<float>(place - std::floor(place));
  return kBelly * (1.0f + kBellyVariation * (2.0f * share - 1.0f));
}

}  // namespace myotact::view
