#pragma once

#include "view/charts/plot_record.h"

namespace myotact::view {

/// Which rows of a record, and how high [pixels].
struct PlotSpan {
  std::size_t first = 0;
  double window_s = 8.0;  // the time axis ends with the last row
  float height = 80.0f;
};

/// Draws a sheet's curves into the current ImGui window: name and newest value of each, lowest and highest of all at
/// the axis, the times at its ends; where the cursor is, the values there.
void draw_plot(const PlotRecord& record, const PlotSheet& sheet, const PlotSpan& span);

}  // namespace myotact::view
