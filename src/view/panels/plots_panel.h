#pragma once

#include <optional>
#include <string>

#include "view/charts/plot_record.h"
#include "view/panels/panel.h"

namespace myotact::view {

/// Curves of the last seconds: of the joint that is watched, of the tools' force, of the tension of muscles that a
/// person chose. They can be held and written to files.
class PlotsPanel {
 public:
  /// Every picture, drawn or not, so that no curve has gaps.
  void add(const PanelContext& context);
  void draw(const PanelContext& context);

 private:
  void draw_buttons(const PanelContext& context, const std::vector<PlotSheet>& sheets);
  /// Into the person's folder "exports"; message_ states where, or what is wrong.
  void save_csv(const PanelContext& context, const std::vector<PlotSheet>& sheets);
  void save_svg(const PanelContext& context, const std::vector<PlotSheet>& sheets);
  const PlotRecord& shown() const { return held_ ? *held_ : record_; }

  PlotRecord record_;
  std::optional<PlotRecord> held_;  // while the curves stand still
  double window_s_ = 8.0;
  std::string message_;
};

}  // namespace myotact::view
