#pragma once

#include <string>
#include <vector>

namespace myotact::view {

/// A scrolling curve of the last seconds: keeps the samples, draws itself into the current ImGui window.
class Plot {
 public:
  /// `label`: key of its text, which names the unit. The range of the axis is never smaller than `smallest_range`.
  Plot(std::string label, double smallest_range) : label_(std::move(label)), smallest_range_(smallest_range) {}

  void add(double time_s, double value);
  void clear();
  /// Draws a curve of the given height in pixels; the cursor reads values.
  void draw(float height) const;

 private:
  struct Sample {
    double time_s, value;
  };
  static constexpr double kWindow_s = 8.0;

  std::string label_;
  double smallest_range_;
  std::vector<Sample> samples_;  // rising in time
};

}  // namespace myotact::view
