#pragma once

#include "view/frame_history.h"
#include "view/layout.h"
#include "view/panels/panel.h"

namespace myotact::view {

/// Below the scene when a recording is played: play and pause, how fast, and any moment of it. The recording is
/// simulated again as far as it is looked at; what was simulated once is kept, so that going back shows at once.
class ReplayPanel {
 public:
  /// Moves on by the time of the last picture, and asks for what is to be simulated. Returns the frame that is to be
  /// drawn, valid until the next call.
  const messages::SceneFrame& choose(const messages::SceneFrame& newest, double length_s, ViewControls& controls);
  void draw(PanelContext& context);
  /// To the moment before or after.
  void step(int by);

 private:
  FrameHistory history_;
  messages::SceneFrame shown_;
  double place_s_ = 0.0;  // of the recording, that is looked at
  double newest_s_ = 0.0, length_s_ = 0.0;
  double speed_ = 1.0;
  std::uint32_t steps_ = 0, resets_ = 0;  // obeyed
};

}  // namespace myotact::view
