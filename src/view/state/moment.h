#pragma once

#include <optional>

#include "messages/moment.h"
#include "messages/scene_frame.h"

namespace myotact::view {

/// What of this frame a scene can be set back to; none where nothing was simulated yet, or it has more parts than that.
std::optional<messages::Moment> moment_of(const messages::SceneFrame& frame);

}  // namespace myotact::view
