#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "app/guarded_motors.h"
#include "app/joint_watch.h"
#include "app/options.h"
#include "device/mouse_device.h"
#include "device/simulated_device.h"
#include "scene/free_session.h"
#include "simulation/simulation.h"
#include "view/window.h"

namespace myotact::app {

/// The devices of a scene's tools, and which of them the script moves.
struct Hands {
  Hands(const Options& options, const scene::Scene& scene, GuardedMotors& guarded);

  std::size_t led;            // the tool that the mouse moves; none: as many as there are tools
  device::MouseDevice mouse;  // of that one
  std::vector<std::unique_ptr<device::SimulatedDevice>> simulated;
  std::vector<scene::ToolDevice> devices;  // one a tool
};

/// A scene on the wall clock with all that belongs to it. Another scene is another stage, built while this one runs.
class Stage {
 public:
  /// Loads and builds, which takes seconds; any thread. Throws Error. `guarded` outlives it.
  Stage(const Options& options, GuardedMotors& guarded);
  ~Stage();

  scene::Scene& scene() { return scene_; }
  scene::FreeSession& session() { return session_; }
  const view::JointReadings& readings(const messages::SceneFrame& frame, double common) {
    return watch_.read(frame, common, session_);
  }
  void move_hand(const view::ViewControls& controls);
  /// `options`: what it was made with.
  view::WindowSettings window_settings(const Options& options) const;

 private:
  scene::Scene scene_;
  Hands hands_;
  simulation::Simulation simulation_;
  std::unique_ptr<scene::RecordingWriter> recorder_;
  scene::FreeSession session_;
  JointWatch watch_;
};

}  // namespace myotact::app
