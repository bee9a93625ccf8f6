#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/joint_readings.h"
#include "view/plot.h"
#include "view/view_controls.h"

namespace myotact::view {

inline constexpr float kPanelWidth = 400.0f;  // pixels

/// Curves and settings that the panels keep between pictures.
struct PanelState {
  Plot angle{"joint angle q [deg]", 4.0};
  Plot stiffness{"joint stiffness [N m/rad]", 1.0};
  Plot force{"tool force [N]", 1.0};  // of all tools, added up
  std::string note;
  JointReadings readings;
  std::vector<double> device_peaks_N{3.3};  // of the tools' devices
  int joint = 0;                            // shown in the plots
  bool help = false;
};

/// Panel at the right: play, sliders, muscles, plots, rates. Draws with ImGui; call between its NewFrame and Render.
void draw_panels(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, PanelState& state,
                 ViewControls& controls);

}  // namespace myotact::view
