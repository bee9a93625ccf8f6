#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/joint_readings.h"
#include "view/view_controls.h"
#include "view/view_state.h"

namespace myotact::view {

/// What does not change while a scene is open.
struct SceneFacts {
  std::string name, title;
  std::string note;                         // what a person should know about its settings
  std::vector<double> device_peaks_N{3.3};  // of the tools' devices
  int joint = 0;                            // that is watched: co-contracted, or the first
};

/// What every panel gets to read and to change, each picture anew. Panels draw with ImGui between its NewFrame and
/// Render, and keep to themselves what only they need.
struct PanelContext {
  const anatomy::Specimen& specimen;
  const messages::SceneFrame& frame;
  const SceneFacts& facts;
  const JointReadings& readings;
  ViewState& view;         // how it is looked at
  ViewControls& controls;  // what is asked of the scene
};

}  // namespace myotact::view
