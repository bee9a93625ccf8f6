#pragma once

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/look/camera.h"
#include "view/look/part.h"

namespace myotact::view {

/// Box round the specimen at the file pose.
ViewBox bounds_of(const anatomy::Specimen& specimen);
/// Box round the bones as they stand and the skins as they are in this frame; that of the file pose for a frame that
/// holds neither.
ViewBox bounds_of(const anatomy::Specimen& specimen, const messages::SceneFrame& frame);
/// Box round one part in this frame.
ViewBox bounds_of(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, const Part& part);

}  // namespace myotact::view
