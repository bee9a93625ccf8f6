#pragma once

#include <optional>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/look/camera.h"
#include "view/look/part.h"

namespace myotact::view {

/// A ray in the world; the direction is a unit vector.
struct Ray {
  glm::vec3 origin_m{0.0f}, direction{1.0f, 0.0f, 0.0f};
};

/// Through a place of the picture: x from its left, y from its top edge, both 0 .. 1.
Ray ray_through(const Camera& camera, float x_share, float y_share, float aspect);

struct PickHit {
  Part part;
  glm::vec3 point_world_m{0.0f};
  float distance_m = 0.0f;  // along the ray
};

/// The part that a person sees there: the nearest that the ray meets of the posed bones and the skins as they are. What
/// is hidden, faded through (opacity below kSolidOpacity) or cut away is passed. `superficial`: as for opacity_of().
/// Boxes first: fast enough for each move of a mouse. Pure; any thread.
std::optional<PickHit> pick(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, const ViewState& view,
                            const std::vector<bool>& superficial, const Ray& ray);

}  // namespace myotact::view
