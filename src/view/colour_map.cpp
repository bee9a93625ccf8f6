#include "view/colour_map.h"

#include <algorithm>
#include <array>

namespace myotact::view {

glm::vec3 cividis(double level) {
  // Ten evenly spaced colours of the published table, sRGB.
  static constexpr std::array<std::array<int, 3>, 10> kStops = {{{0, 32, 77},
                                                                 {0, 51, 111},
                                                                 {57, 72, 107},
                                                                 {87, 92, 109},
                                                                 {112, 113, 115},
                                                                 {138, 135, 121},
                                                                 {166, 157, 117},
                                                                 {196, 181, 108},
                                                                 {228, 207, 91},
                                                                 {255, 234, 70}}};
  const double place = std::clamp(level, 0.0, 1.0) * static_cast<double>(kStops.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const auto s = static_cast<float>(place - static_cast<double>(below));
  glm::vec3 colour;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    colour[k] =
        ((1.0f - s) * static_cast<float>(kStops[below][i]) + s * static_cast<float>(kStops[below + 1][i])) / 255.0f;
  }
  return colour;
}

}  // namespace myotact::view
