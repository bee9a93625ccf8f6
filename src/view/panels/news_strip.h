#pragma once

#include <string>

#include "view/panels/panel.h"
#include "view/ui/layout.h"

namespace myotact::view {

/// What a person should know now, over the top of the scene: a sentence to be read, a scene that is being prepared,
/// what is wrong with the touch or a device, a computer that is too slow, each with what to do about it.
class NewsStrip {
 public:
  /// `message`: stays until it is dismissed, and is empty then. Call outside of ImGui's windows.
  void draw(PanelContext& context, const Area& scene, std::string& message);

 private:
  void count_slow_time(const PanelContext& context);
  void draw_too_slow(PanelContext& context) const;
  void draw_devices(const PanelContext& context) const;

  float slow_s_ = 0.0f;  // for how long the simulation has been behind
};

}  // namespace myotact::view
