#pragma once

#include <chrono>
#include <optional>

#include "measure/line_limb.h"
#include "messages/scene_frame.h"
#include "scene/free_session.h"
#include "scene/scene_file.h"
#include "view/state/joint_readings.h"

namespace myotact::app {

/// What the window shows about the stiffness of the co-contraction's joint, a few times a second. On the drawing
/// thread.
class JointWatch {
 public:
  explicit JointWatch(const scene::Scene& scene);

  /// Readings of the frame; the last ones until it is time for new ones. The band is of the level in force.
  const view::JointReadings& read(const messages::SceneFrame& frame, scene::FreeSession& session);

 private:
  const scene::Scene& scene_;
  std::optional<measure::LineLimb> lines_;  // none without a co-contraction
  std::chrono::steady_clock::time_point next_;
  view::JointReadings readings_;
};

}  // namespace myotact::app
