#include "view/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace myotact::view {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr glm::vec3 kUp{0.0f, 0.0f, 1.0f};

}  // namespace

glm::vec3 Camera::forward_world() const {
  return -glm::vec3(std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
                    std::sin(elevation_rad));
}

glm::vec3 Camera::eye_world_m() const { return target_world_m - distance_m * forward_world(); }

glm::vec3 Camera::right_world() const { return glm::normalize(glm::cross(forward_world(), kUp)); }

glm::vec3 Camera::up_world() const { return glm::cross(right_world(), forward_world()); }

glm::mat4 Camera::clip_from_world(float aspect) const {
  const glm::mat4 projection = glm::perspective(kFieldOfView_rad, aspect, 0.05f * distance_m, 20.0f * distance_m);
  return projection * glm::lookAt(eye_world_m(), target_world_m, kUp);
}

void Camera::orbit(float azimuth, float elevation) {
  azimuth_rad = std::remainder(azimuth_rad + azimuth, 2.0f * kPi);
  elevation_rad = std::clamp(elevation_rad + elevation, -kSteepest_rad, kSteepest_rad);
}

void Camera::pan(float right, float up) {
  const float height_m = 2.0f * distance_m * std::tan(0.5f * kFieldOfView_rad);
  target_world_m -= height_m * (right * right_world() + up * up_world());
}

void Camera::zoom(float factor) { distance_m = std::clamp(distance_m * factor, 0.02f, 20.0f); }

std::optional<Camera> standard_view(const std::string& name, bool left_limb, const glm::vec3& lowest_m,
                                    const glm::vec3& highest_m) {
  const float lateral = left_limb ? 0.5f * kPi : -0.5f * kPi;
  Camera camera;
  if (name == "lateral") {
    camera.azimuth_rad = lateral;
  } else if (name == "medial") {
    camera.azimuth_rad = -lateral;
  } else if (name == "cranial") {
    camera.azimuth_rad = 0.0f;
  } else if (name == "caudal") {
    camera.azimuth_rad = kPi;
  } else if (name == "dorsal" || name == "palmar") {
    camera.azimuth_rad = kPi;
    camera.elevation_rad = name == "dorsal" ? Camera::kSteepest_rad : -Camera::kSteepest_rad;
  } else {
    return std::nullopt;
  }
  camera.target_world_m = 0.5f * (lowest_m + highest_m);
  constexpr float kMargin = 1.02f;
  const float radius_m = 0.5f * glm::length(highest_m - lowest_m);
  camera.distance_m = kMargin * std::max(radius_m, 0.01f) / std::sin(0.5f * Camera::kFieldOfView_rad);
  return camera;
}

}  // namespace myotact::view
