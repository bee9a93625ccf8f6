#pragma once

#include "app/stage.h"
#include "scene/replay_session.h"

namespace myotact::app {

/// A recording that is played, and nothing that could be felt.
class ReplayStage final : public Stage {
 public:
  /// Loads and builds, which takes seconds; any thread. Throws Error.
  explicit ReplayStage(const Options& options);

  const scene::Scene& scene() const override { return loaded_.scene; }
  scene::Session& session() override { return session_; }
  view::WindowSettings window_settings(const Options& options) const override;
  void lead(const view::ViewControls& controls) override { session_.play_to(controls.replay_to_s); }

 private:
  const scene::LoadedRecording loaded_;
  scene::ReplaySession session_;
};

}  // namespace myotact::app
