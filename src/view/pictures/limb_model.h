#pragma once

#include "anatomy/specimen.h"
#include "geometry/glb.h"
#include "messages/scene_frame.h"
#include "view/look/view_state.h"

namespace myotact::view {

/// The limb as it stands in the frame, for other programs: each bone and muscle a node with its English name and, among
/// its extras, its key, kind and Latin name. What the view hides is left out, what it fades shines through; a muscle's
/// tendons are a surface of their own. Colours are those of the tissues, whatever the view lays over them.
geometry::GlbScene limb_model(const anatomy::Specimen& specimen, const messages::SceneFrame& frame,
                              const ViewState& view);

}  // namespace myotact::view
