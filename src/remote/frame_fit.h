#pragma once

#include <string>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"

namespace myotact::remote {

/// What of a frame from elsewhere does not fit the specimen, so that it cannot be drawn, with its size or value; empty:
/// it fits. Indices and counts are the specimen's, and every place is a number.
std::string misfit(const messages::SceneFrame& frame, const anatomy::Specimen& specimen);

}  // namespace myotact::remote
