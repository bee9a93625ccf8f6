#include "view/state/moment.h"

#include <algorithm>

namespace myotact::view {

std::optional<messages::Moment> moment_of(const messages::SceneFrame& frame) {
  messages::Moment moment;
  const bool fits = frame.joints.size() <= moment.angles_rad.size() &&
                    frame.activations.size() <= moment.activations.size() && !frame.body_poses.empty();
  if (!fits) return std::nullopt;
  std::transform(frame.joints.begin(), frame.joints.end(), moment.angles_rad.begin(),
                 [](const messages::JointFrame& joint) { return joint.angle_rad; });
  std::transform(frame.activations.begin(), frame.activations.end(), moment.activations.begin(),
                 [](double activation) { return static_cast<float>(activation); });
  moment.joints = static_cast<std::uint32_t>(frame.joints.size());
  moment.muscles = static_cast<std::uint32_t>(frame.activations.size());
  moment.control = frame.control;
  return moment;
}

}  // namespace myotact::view
