#pragma once

#include <array>
#include <optional>
#include <string>

#include <glm/glm.hpp>

namespace myotact::view {

/// Looks at a point of the world from a direction; never rolls: up on the screen is up in the world (z).
struct Camera {
  glm::vec3 target_world_m{0.0f};
  float azimuth_rad = 0.0f;    // of the eye about z, 0 on +x (cranial), pi/2 on +y (left)
  float elevation_rad = 0.0f;  // -kSteepest .. kSteepest
  float distance_m = 1.0f;

  static constexpr float kFieldOfView_rad = 0.55f;
  static constexpr float kSteepest_rad = 1.55f;  // short of straight down, where up would be undefined

  glm::vec3 eye_world_m() const;
  glm::mat4 clip_from_world(float aspect) const;
  /// Moves the eye about the target.
  void orbit(float azimuth_rad, float elevation_rad);
  /// Moves the target in the picture's plane; 1 is the picture's height.
  void pan(float right, float up);
  /// Moves the eye towards the target, factor < 1 comes nearer.
  void zoom(float factor);
  glm::vec3 right_world() const;
  glm::vec3 up_world() const;
  glm::vec3 forward_world() const;

  bool operator==(const Camera&) const = default;
};

/// Its right, up and towards the eye.
std::array<std::array<double, 3>, 3> axes_of(const Camera& camera);

struct ViewBox {
  glm::vec3 lowest_m{0.0f}, highest_m{0.0f};
};

/// What a device that rotates the view does to it within `dt_s`, as if its cap were the limb: pushed to the right, up
/// and towards the person, each -1 .. 1.
void push_view(Camera& camera, const std::array<double, 3>& push, float dt_s);

/// From the same side, so near and so placed that the box fills a picture of that width over height.
Camera framed(const Camera& camera, const ViewBox& box, float aspect);

/// On the way from one view to another, share 0 .. 1 of it; rotates by the smaller angle.
Camera between(const Camera& from, const Camera& to, float share);

/// Standard views of a limb: lateral, medial, cranial, caudal, dorsal, palmar; nothing for another name. `left_limb`:
/// lateral is the limb's own left side. The whole box fits into a picture of the given width over height.
std::optional<Camera> standard_view(const std::string& name, bool left_limb, const ViewBox& box, float aspect);

}  // namespace myotact::view
