#pragma once

#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/look/part.h"

namespace myotact::view {

/// A part of which something is seen.
struct SeenPart {
  Part part;
  glm::vec2 place{
      0.0f};            // of the picture, from its top left corner, 0 .. 1: on the part, in the middle of what is seen
  float middle = 0.0f;  // of the limb at that height, as a share of the picture's width
  float share = 0.0f;   // of the picture
};

struct SeenLimb {
  std::vector<SeenPart> parts;      // muscles first, as in the specimen
  float left = 0.0f, right = 0.0f;  // of the limb, shares of the picture's width
};

/// What of the limb is seen, from a coarse picture of depths. What is hidden, faded through or cut away does not count.
/// `superficial`: as for opacity_of().
SeenLimb seen_parts(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, const ViewState& view,
                    const std::vector<bool>& superficial, float aspect);

}  // namespace myotact::view
