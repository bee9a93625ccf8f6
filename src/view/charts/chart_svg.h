#pragma once

#include <string>
#include <vector>

namespace myotact::view {

/// Rings and Dots are markers alone.
enum class Stroke { Line, Dashed, Rings, Dots };

struct ChartSeries {
  std::string name;          // of its line in the legend; empty: none
  std::vector<double> x, y;  // same length
  Stroke stroke = Stroke::Line;
  std::vector<double> low = {}, high = {};  // a band to shade, as long as x; or empty
  int colour = -1;                          // of the palette, -1: that of its place in the chart; kInk: the text's
};

/// Series of more colours repeat them.
inline constexpr int kChartColours = 6;

/// For series without points, which only explain a stroke in the legend.
inline constexpr int kInk = -2;

struct Chart {
  std::string title;
  std::string x_label, y_label;  // with units
  std::vector<ChartSeries> series;
  bool x_from_zero = true;  // zero is on the x axis; false: only what the series hold
};

/// A line chart as an SVG document: round ticks, markers, a colour-blind-safe palette of kChartColours, the legend
/// beside the plot, no outside fonts.
std::string line_chart_svg(const Chart& chart);

/// Charts of line_chart_svg() under each other as one document.
std::string stacked_svg(const std::vector<std::string>& charts);

/// Ticks at round numbers (1, 2 or 5 times a power of ten) that cover [lowest, highest], about `wanted` of them.
std::vector<double> round_ticks(double lowest, double highest, int wanted);

}  // namespace myotact::view
