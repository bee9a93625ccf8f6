#pragma once

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/render/drawable.h"

namespace myotact::view {

/// The soft shadow of what of the bones stands on the ground or close above it, or nothing: an ellipse on the ground,
/// dark in the middle, as wide as what casts it. So a limb stands and does not float. Appended to `mesh` as triangles.
void add_ground_shadow(DrawMesh& mesh, const anatomy::Specimen& specimen, const messages::SceneFrame& frame,
                       float ground_m);

}  // namespace myotact::view
