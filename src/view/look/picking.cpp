#include "view/look/picking.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "view/look/limb_bounds.h"
#include "view/look/posing.h"
#include "view/look/visibility.h"

namespace myotact::view {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool meets_box(const Ray& ray, const ViewBox& box) {
  float enter = 0.0f, leave = kInfinity;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(ray.direction[k]) < 1e-12f) {
      if (ray.origin_m[k] < box.lowest_m[k] || ray.origin_m[k] > box.highest_m[k]) return false;
      continue;
    }
    const float a = (box.lowest_m[k] - ray.origin_m[k]) / ray.direction[k];
    const float b = (box.highest_m[k] - ray.origin_m[k]) / ray.direction[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

/// Distance along the ray to a triangle, from either side (Moeller and Trumbore 1997), or infinity.
float distance_to_triangle_m(const Ray& ray, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 ab = b - a, ac = c - a;
  const glm::vec3 p = glm::cross(ray.direction, ac);
  const float det = glm::dot(ab, p);
  if (std::abs(det) < 1e-20f) return kInfinity;
  const glm::vec3 s = ray.origin_m - a;
  const float u = glm::dot(s, p) / det;
  if (u < 0.0f || u > 1.0f) return kInfinity;
  const glm::vec3 q = glm::cross(s, ab);
  const float v = glm::dot(ray.direction, q) / det;
  if (v < 0.0f || u + v > 1.0f) return kInfinity;
  const float t = glm::dot(ac, q) / det;
  return t > 0.0f ? t : kInfinity;
}

/// Nearest kept place of a surface that the ray meets; `at(i)`: vertex i in the frame of the ray.
template <typename At>
float distance_to_surface_m(const Ray& ray, const geometry::TriangleMesh& surface, const glm::vec4& kept,
                            const At& at) {
  float nearest_m = kInfinity;
  for (const auto& [a, b, c] : surface.triangles) {
    const float t = distance_to_triangle_m(ray, at(a), at(b), at(c));
    if (t < nearest_m && is_kept(kept, ray.origin_m + t * ray.direction)) nearest_m = t;
  }
  return nearest_m;
}

struct Query {
  const anatomy::Specimen& specimen;
  const messages::SceneFrame& frame;
  const Ray& ray;
  glm::vec4 kept;

  /// In the frame of the bone, whose vertices then need not be moved.
  float distance_to_bone_m(std::size_t b) const {
    const glm::mat4 bone_from_world = glm::inverse(pose_of_bone(specimen, frame, b));
    const Ray turned{glm::vec3(bone_from_world * glm::vec4(ray.origin_m, 1.0f)),
                     glm::vec3(bone_from_world * glm::vec4(ray.direction, 0.0f))};
    const glm::vec4 turned_kept = kept * glm::inverse(bone_from_world);
    const auto& surface = specimen.bones[b].surface;
    return distance_to_surface_m(turned, surface, turned_kept,
                                 [&](int i) { return to_glm(surface.positions_m[static_cast<std::size_t>(i)]); });
  }
  float distance_to_muscle_m(std::size_t m) const {
    const auto& skin = frame.skins_world_m[m];
    return distance_to_surface_m(ray, specimen.muscles[m].skin, kept,
                                 [&](int i) { return to_glm(skin[static_cast<std::size_t>(i)]); });
  }
  float distance_m(const Part& part) const {
    const auto i = static_cast<std::size_t>(part.index);
    if (part.kind == PartKind::Muscle && i >= frame.skins_world_m.size()) return kInfinity;
    if (!meets_box(ray, bounds_of(specimen, frame, part))) return kInfinity;
    return part.kind == PartKind::Bone ? distance_to_bone_m(i) : distance_to_muscle_m(i);
  }
};

}  // namespace

Ray ray_through(const Camera& camera, float x_share, float y_share, float aspect) {
  const float slope = std::tan(0.5f * Camera::kFieldOfView_rad);
  const glm::vec3 direction = camera.forward_world() + slope * aspect * (2.0f * x_share - 1.0f) * camera.right_world() +
                              slope * (1.0f - 2.0f * y_share) * camera.up_world();
  return {camera.eye_world_m(), glm::normalize(direction)};
}

std::optional<PickHit> pick(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, const ViewState& view,
                            const std::vector<bool>& superficial, const Ray& ray) {
  const Query query{specimen, frame, ray,
                    view.section.on ? kept_half_space(view.section, bounds_of(specimen)) : glm::vec4(0, 0, 0, 1)};
  PickHit nearest;
  nearest.distance_m = kInfinity;
  const auto look_at = [&](const Part& part) {
    if (opacity_of(view, superficial, part) < kSolidOpacity) return;
    const float t = query.distance_m(part);
    if (t < nearest.distance_m) nearest = {part, ray.origin_m + t * ray.direction, t};
  };
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) look_at({PartKind::Muscle, static_cast<int>(m)});
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) look_at({PartKind::Bone, static_cast<int>(b)});
  if (!nearest.part) return std::nullopt;
  return nearest;
}

}  // namespace myotact::view
