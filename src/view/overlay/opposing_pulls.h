#pragma once

#include <array>

#include <glm/glm.hpp>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"

namespace myotact::view {

/// What all muscles of one side of a joint pull with together, where they pass it [world].
struct GroupPull {
  glm::vec3 place_m{0.0f};  // mean of their places, weighted with their tensions
  glm::vec3 force_N{0.0f};  // on the body beyond the joint, along their lines towards the origins
  float full_N = 0.0f;      // the sum of their largest isometric forces
  float longest_m = 0.0f;   // of their lines
};

/// Flexors, then extensors, by the sign of the torque that each muscle has now. None where `joint` is none.
std::array<GroupPull, 2> opposing_pulls(const anatomy::Specimen& specimen, const messages::SceneFrame& frame,
                                        int joint);

}  // namespace myotact::view
