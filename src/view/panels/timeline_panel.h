#pragma once

#include <optional>
#include <string>

#include "view/panels/panel.h"
#include "view/state/frame_history.h"
#include "view/ui/layout.h"

namespace myotact::view {

/// Below the scene: play and pause, and a way back to any time of the last minutes. Looking back changes what is drawn
/// and nothing else: simulation, sliders and forces stay in the present, unless the person goes on from there.
class TimelinePanel {
 public:
  /// Keeps the present frame; returns the one that is to be drawn: the present, or the past one that is looked at.
  /// Valid until the next call.
  const messages::SceneFrame& choose(const messages::SceneFrame& present);
  void draw(PanelContext& context);
  /// Over the scene, while the past is looked at: to go on from there.
  void draw_go_on(PanelContext& context, const Area& scene);
  /// Shows over the scene that this is the past.
  void draw_past_banner(const Area& scene) const;

  bool looks_back() const { return past_s_.has_value(); }
  /// To the frame before the one that is looked at, or after; past the newest: to the present.
  void step(int by);
  void back_to_now() { past_s_.reset(); }

 private:
  FrameHistory history_;
  std::optional<double> past_s_;  // the time that is looked at; none: the present
  messages::SceneFrame past_;
  double newest_s_ = 0.0;
};

/// A sentence at the top of the scene: that it is not what happens now.
void draw_banner(const Area& scene, const std::string& text);

}  // namespace myotact::view
