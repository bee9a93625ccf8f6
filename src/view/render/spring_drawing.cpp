#include "view/render/spring_drawing.h"

#include <cmath>
#include <numbers>

namespace myotact::view {

namespace {

constexpr glm::vec4 kSteel{0.45f, 0.48f, 0.54f, 1.0f};
constexpr float kWire_m = 0.35e-3f, kCoil_m = 1.8e-3f;  // radii; thinner than a tool
constexpr int kTurns = 12, kCorners = 10;               // corners of a turn
constexpr float kStraight = 0.08f;                      // share of the way at each end

}  // namespace

void add_spring(DrawMesh& mesh, const glm::vec3& from_m, const glm::vec3& to_m) {
  const glm::vec3 way_m = to_m - from_m;
  const float length_m = glm::length(way_m);
  if (!(length_m > 1e-5f)) return;
  const glm::vec3 axis = way_m / length_m;
  const glm::vec3 aside = std::abs(axis.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  const glm::vec3 u = glm::normalize(glm::cross(axis, aside)), v = glm::cross(axis, u);
  glm::vec3 last_m = from_m;
  const auto go_to = [&](const glm::vec3& place_m) {
    add_thread(mesh, last_m, place_m, kWire_m, kSteel);
    last_m = place_m;
  };
  go_to(from_m + kStraight * way_m);
  constexpr int kPieces = kTurns * kCorners;
  for (int i = 0; i <= kPieces; ++i) {
    const float share = static_cast<float>(i) / kPieces;
    const float angle_rad = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / kCorners;
    const float along = kStraight + (1.0f - 2.0f * kStraight) * share;
    go_to(from_m + along * way_m + kCoil_m * (std::cos(angle_rad) * u + std::sin(angle_rad) * v));
  }
  go_to(to_m - kStraight * way_m);
  go_to(to_m);
}

}  // namespace myotact::view
