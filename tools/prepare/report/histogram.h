#pragma once

#include <string>
#include <vector>

namespace myotact::prepare {

/// What a histogram shows: values between `lowest` and `highest` in `bars` bars; a dashed line stands at `limit`.
struct HistogramScale {
  std::string title, unit;
  double lowest = 0.0, highest = 1.0;
  int bars = 24;
  double limit = 0.0;
};

/// As an SVG element. Values outside count in the first or last bar.
std::string histogram_svg(const std::vector<double>& values, const HistogramScale& scale);

}  // namespace myotact::prepare
