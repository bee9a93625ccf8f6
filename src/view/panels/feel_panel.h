#pragma once

#include <optional>

#include "view/panels/panel.h"
#include "view/render/pressure_map.h"

namespace myotact::view {

/// What the hand feels now, beside what its device can give and what the teacher wants, and of what it is made; how the
/// devices on the table are.
class FeelPanel {
 public:
  explicit FeelPanel(const anatomy::Specimen& specimen) : map_(specimen) {}

  /// Every picture, drawn or not, so that the map has no gaps.
  void add(const messages::SceneFrame& frame) { map_.add(frame); }
  void draw(PanelContext& context);
  const PressureMap& map() const { return map_; }

 private:
  void draw_tools(PanelContext& context);
  void draw_gauge(const messages::ToolFrame& tool);

  PressureMap map_;
  double band_low_kPa_ = 15.0, band_high_kPa_ = 40.0;  // a light palpation: 0.4 to 1.1 N with a 3 mm tool
};

}  // namespace myotact::view
