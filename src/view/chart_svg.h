#pragma once

#include <string>
#include <vector>

namespace myotact::view {

struct ChartSeries {
  std::string name;
  std::vector<double> x, y;  // same length
};

struct Chart {
  std::string title;
  std::string x_label, y_label;  // with units
  std::vector<ChartSeries> series;
};

/// A line chart as an SVG document: round ticks, markers, a colour-blind-safe palette, no outside fonts.
std::string line_chart_svg(const Chart& chart);

/// Ticks at round numbers (1, 2 or 5 times a power of ten) that cover [lowest, highest], about `wanted` of them.
std::vector<double> round_ticks(double lowest, double highest, int wanted);

}  // namespace myotact::view
