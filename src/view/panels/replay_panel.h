#pragma once

#include "view/panels/panel.h"
#include "view/state/frame_history.h"
#include "view/ui/layout.h"

namespace myotact::view {

/// Below the scene when a recording is played: play and pause, how fast, and any moment of it. The recording is
/// simulated again as far as it is looked at; what was simulated once is kept, so that going back shows at once.
class ReplayPanel {
 public:
  /// Moves on by the time of the last picture, unless it is paused. Returns the frame that is to be drawn, valid until
  /// the next call.
  const messages::SceneFrame& choose(const messages::SceneFrame& newest, double length_s, SceneControls& scene);
  void draw(PanelContext& context);
  /// To the moment before or after.
  void step(int by);
  /// Steps and resets that were asked for move the place.
  void obey(const messages::Order& order);
  double place_s() const { return place_s_; }  // of the recording, to be simulated up to there

 private:
  FrameHistory history_;
  messages::SceneFrame shown_;
  double place_s_ = 0.0;  // of the recording, that is looked at
  double newest_s_ = 0.0, length_s_ = 0.0;
  double speed_ = 1.0;
};

}  // namespace myotact::view
