#pragma once

#include <filesystem>
#include <vector>

#include "core/vector.h"

namespace myotact::measure {

/// Farther than this from the origin nothing is felt: a file in millimetres shows here, and so does a slip of typing.
inline constexpr double kFarthest_m = 10.0;
/// A hand that throws moves at less (a fast arm movement: 6-8 m/s at the wrist); a larger jump is a slip of the file.
inline constexpr double kFastestPath_m_s = 10.0;
/// At most so many rows come out: half an hour at 1 kHz, 300 MB of text.
inline constexpr std::size_t kMostTicks = 2'000'000;

/// Where the device is, straight between points.
struct ProbePath {
  std::vector<double> t_s;  // n >= 1, rising
  std::vector<Vec3> position_m;

  /// Held before the first and after the last point.
  Vec3 at(double time_s) const;
  double duration_s() const { return t_s.back() - t_s.front(); }
};

/// A table `t_s, x_m, y_m, z_m`. Throws Error: NoInput, or BadData with the line for what is no
/// number, too far, goes back in time or jumps.
ProbePath load_path(const std::filesystem::path& file);

}  // namespace myotact::measure
