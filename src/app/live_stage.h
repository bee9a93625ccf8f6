#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "app/hands.h"
#include "app/joint_watch.h"
#include "app/stage.h"
#include "scene/free_session.h"
#include "simulation/simulation.h"
#include "view/window/window.h"

namespace myotact::app {

/// A scene that is simulated here, on the wall clock.
class LiveStage final : public Stage {
 public:
  /// Loads and builds, which takes seconds; any thread. Throws Error. `guarded` and `equipment` outlive it.
  LiveStage(const Options& options, GuardedMotors& guarded, const Equipment& equipment);
  ~LiveStage() override;

  const scene::Scene& scene() const override { return scene_; }
  scene::Session& session() override { return session_; }
  bool simulates() const override { return true; }
  view::JointReadings readings(const messages::SceneFrame& frame) override { return watch_.read(frame, session_); }
  void lead(const view::ViewControls& controls) override;
  std::vector<view::DeviceNews> device_news() const override { return hands_.news(scene_); }
  view::WindowSettings window_settings(const Options& options) const override;
  std::string refused() const override { return session_.timing().refused; }

 private:
  scene::Scene scene_;
  Hands hands_;
  simulation::Simulation simulation_;
  std::unique_ptr<scene::RecordingWriter> recorder_;
  scene::FreeSession session_;
  JointWatch watch_;
};

}  // namespace myotact::app
