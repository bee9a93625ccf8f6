#include "view/look/camera.h"

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

std::array<std::array<double, 3>, 3> axes_of(const Camera& camera) {
  const auto plain = [](const glm::vec3& v) { return std::array<double, 3>{v.x, v.y, v.z}; };
  return {plain(camera.right_world()), plain(camera.up_world()), plain(-camera.forward_world())};
}

glm::vec3 Camera::eye_world_m() const {
  return target_world_m - distance_m * forward_world();
}

glm::vec3 Camera::right_world() const {
  return glm::normalize(glm::cross(forward_world(), kUp));
}

glm::vec3 Camera::up_world() const {
  return glm::cross(right_world(), forward_world());
}

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

void Camera::zoom(float factor) {
  distance_m = std::clamp(distance_m * factor, 0.02f, 20.0f);
}

void push_view(Camera& camera, const std::array<double, 3>& push, float dt_s) {
  constexpr float kTurn_rad_s = 1.5f, kNearer_s = 1.2f;  // round the limb in four seconds, twice as near in half of one
  const glm::vec3 part(static_cast<float>(push[0]), static_cast<float>(push[1]), static_cast<float>(push[2]));
  if (part == glm::vec3(0.0f)) return;
  camera.orbit(-kTurn_rad_s * dt_s * part.x, -kTurn_rad_s * dt_s * part.y);
  camera.zoom(std::exp(-kNearer_s * dt_s * part.z));
}

Camera between(const Camera& from, const Camera& to, float share) {
  const auto mix = [&](auto a, auto b) { return a + share * (b - a); };
  Camera camera;
  camera.target_world_m = mix(from.target_world_m, to.target_world_m);
  camera.azimuth_rad = std::remainder(
      from.azimuth_rad + share * std::remainder(to.azimuth_rad - from.azimuth_rad, 2.0f * kPi), 2.0f * kPi);
  camera.elevation_rad = mix(from.elevation_rad, to.elevation_rad);
  camera.distance_m = mix(from.distance_m, to.distance_m);
  return share < 1.0f ? camera : to;
}

namespace {

/// Distance from which all corners of the box lie inside the picture, with a margin.
float fitting_distance_m(const Camera& camera, const ViewBox& box, float aspect) {
  constexpr float kMargin = 1.08f;
  const float up_slope = std::tan(0.5f * Camera::kFieldOfView_rad) / kMargin;
  float distance_m = 0.05f;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 at((corner & 1) != 0 ? box.highest_m.x : box.lowest_m.x,
                       (corner & 2) != 0 ? box.highest_m.y : box.lowest_m.y,
                       (corner & 4) != 0 ? box.highest_m.z : box.lowest_m.z);
    const glm::vec3 out = at - camera.target_world_m;
    const float up = std::abs(glm::dot(out, camera.up_world())) / up_slope;
    const float right = std::abs(glm::dot(out, camera.right_world())) / (up_slope * aspect);
    distance_m = std::max(distance_m, std::max(up, right) - glm::dot(out, camera.forward_world()));
  }
  return distance_m;
}

}  // namespace

Camera framed(const Camera& camera, const ViewBox& box, float aspect) {
  Camera nearer = camera;
  nearer.target_world_m = 0.5f * (box.lowest_m + box.highest_m);
  nearer.distance_m = fitting_distance_m(nearer, box, aspect);
  return nearer;
}

std::optional<Camera> standard_view(const std::string& name, bool left_limb, const ViewBox& box, float aspect) {
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
  return framed(camera, box, aspect);
}

}  // namespace myotact::view
