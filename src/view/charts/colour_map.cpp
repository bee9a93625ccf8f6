#include "view/charts/colour_map.h"

#include <algorithm>
#include <array>

namespace myotact::view {

namespace {

using Stops = std::array<std::array<int, 3>, 10>;  // evenly spaced, sRGB

glm::vec3 between(const Stops& stops, double level) {
  const double share = level > 0.0 ? std::min(level, 1.0) : 0.0;  // of what is not a number as well
  const double place = share * static_cast<double>(stops.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const auto s = static_cast<float>(place - static_cast<double>(below));
  glm::vec3 colour;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    colour[k] =
        ((1.0f - s) * static_cast<float>(stops[below][i]) + s * static_cast<float>(stops[below + 1][i])) / 255.0f;
  }
  return colour;
}

}  // namespace

glm::vec3 cividis(double level) {
  // Of the published table.
  static constexpr Stops kStops = {{{0, 32, 77},
                                    {0, 51, 111},
                                    {57, 72, 107},
                                    {87, 92, 109},
                                    {112, 113, 115},
                                    {138, 135, 121},
                                    {166, 157, 117},
                                    {196, 181, 108},
                                    {228, 207, 91},
                                    {255, 234, 70}}};
  return between(kStops, level);
}

glm::vec3 red_yellow(double level) {
  static constexpr Stops kStops = {{{152, 62, 52},
                                    {176, 68, 44},
                                    {196, 82, 38},
                                    {213, 99, 33},
                                    {227, 118, 31},
                                    {237, 139, 34},
                                    {244, 160, 41},
                                    {249, 182, 50},
                                    {253, 206, 60},
                                    {255, 232, 72}}};
  return between(kStops, level);
}

std::array<glm::vec3, 10> red_yellow_table() {
  std::array<glm::vec3, 10> table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = red_yellow(static_cast<double>(i) / static_cast<double>(table.size() - 1));
  }
  return table;
}

glm::vec3 blue_orange(double level) {
  constexpr glm::vec3 kBlue{0.00f, 0.35f, 0.66f}, kMiddle{0.93f, 0.91f, 0.88f}, kOrange{0.84f, 0.43f, 0.00f};
  const auto share = static_cast<float>(std::clamp(level, -1.0, 1.0));
  return share < 0.0f ? glm::mix(kMiddle, kBlue, -share) : glm::mix(kMiddle, kOrange, share);
}

}  // namespace myotact::view
