#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "app/hands.h"
#include "app/joint_watch.h"
#include "app/options.h"
#include "scene/free_session.h"
#include "simulation/simulation.h"
#include "view/window.h"

namespace myotact::app {

/// A scene on the wall clock with all that belongs to it. Another scene is another stage, built while this one runs.
class Stage {
 public:
  /// Loads and builds, which takes seconds; any thread. Throws Error. `guarded` and `equipment` outlive it.
  Stage(const Options& options, GuardedMotors& guarded, const Equipment& equipment);
  ~Stage();

  scene::Scene& scene() { return scene_; }
  scene::FreeSession& session() { return session_; }
  const view::JointReadings& readings(const messages::SceneFrame& frame, double common) {
    return watch_.read(frame, common, session_);
  }
  void move_hand(const view::ViewControls& controls);
  std::vector<view::DeviceNews> device_news() const { return hands_.news(scene_); }
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
