#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"

namespace myotact::view {

/// What the plots show, one row a picture: the last minute of it.
class PlotRecord {
 public:
  static constexpr double kKept_s = 60.0;
  /// Of messages::ForceParts, in their order.
  static constexpr std::size_t kForceParts = 8;
  /// Columns before the muscles' tensions.
  enum Column : std::size_t {
    Angle_deg,
    Stiffness_Nm_rad,
    Torque_Nm,
    Force_N,
    FirstPart_N,
    FirstTension_N = FirstPart_N + kForceParts
  };

  /// A row of the frame; none when its time is that of the last row. An earlier time begins anew. `joint`: the one that
  /// is watched. Forces, and their parts, are those of all tools, each one's size added up.
  void add(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, std::size_t joint);

  std::size_t size() const { return times_s_.size(); }
  std::size_t columns() const { return columns_.size(); }
  /// Of simulated time, rising.
  std::span<const double> times_s(std::size_t first = 0) const { return std::span(times_s_).subspan(first); }
  std::span<const double> column(std::size_t column, std::size_t first = 0) const {
    return std::span(columns_[column]).subspan(first);
  }
  /// The first row within the last seconds.
  std::size_t first_within(double seconds) const;
  static std::size_t tension_column(int muscle) { return FirstTension_N + static_cast<std::size_t>(muscle); }

 private:
  std::vector<double> times_s_;
  std::vector<std::vector<double>> columns_;  // each as long as the times
};

/// A plot of curves over the same times.
struct PlotSheet {
  struct Curve {
    std::string name;      // for a person
    std::string csv_name;  // with its unit
    std::size_t column = 0;
  };
  std::string key;  // of its text, which names the unit
  double smallest_range = 1.0;
  std::vector<Curve> curves;
};

/// Time and every curve of the sheets, rows from `first` on, numbers that read back to the same double.
std::string csv_of(const PlotRecord& record, std::span<const PlotSheet> sheets, std::size_t first);
/// One sheet as an SVG document. `title`, `label`: of the chart and of its y axis; `time_label`: of the x axis.
struct SheetTexts {
  std::string title, label, time_label;
};
std::string svg_of(const PlotRecord& record, const PlotSheet& sheet, std::size_t first, const SheetTexts& texts);

}  // namespace myotact::view
