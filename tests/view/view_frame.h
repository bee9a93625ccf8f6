#pragma once

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"

namespace myotact::testing {

/// What the view would be given of a specimen at rest at its file pose.
inline messages::SceneFrame frame_at_rest(const anatomy::Specimen& specimen, double activation = 0.0) {
  messages::SceneFrame frame;
  frame.body_poses.assign(specimen.bodies.size(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  for (const auto& muscle : specimen.muscles) {
    frame.skins_world_m.emplace_back();
    for (const Vec3& p : muscle.skin.positions_m) {
      frame.skins_world_m.back().push_back(
          {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    }
    frame.activations.push_back(activation);
    frame.tensions_N.push_back(0.0);
    frame.stretches.push_back(1.0);
    frame.volume_ratios.push_back(1.0);
    frame.smallest_volume_ratios.push_back(1.0);
  }
  for (const auto& line : specimen.lines) {
    frame.lines_world_m.emplace_back();
    for (const auto& point : line.points) frame.lines_world_m.back().push_back(to_array(point.position_m));
  }
  frame.joints.resize(specimen.joints.size());
  for (auto& joint : frame.joints) joint.muscles.resize(specimen.muscles.size());
  return frame;
}

}  // namespace myotact::testing
