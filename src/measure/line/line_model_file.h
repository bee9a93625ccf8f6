#pragma once

#include <filesystem>
#include <vector>

#include "measure/line/line_joint.h"

namespace myotact::measure {

/// A line model (assets/cases/README.md): one hinge, its muscles, and what to report of it.
struct LineModel {
  LineJoint joint;
  bool short_range_stiffness = false;  // reported beside the static one
  std::vector<double> q_rad;
  std::vector<double> levels;  // of co-contraction, 0 .. 1
};

/// Whether a file holds a line model and no scene, by its keys. False for what is no JSON object or not there.
bool is_line_model(const std::filesystem::path& path);

/// Throws Error: NoInput, or BadData naming file, place, value, allowed range and remedy.
LineModel load_line_model(const std::filesystem::path& path);

}  // namespace myotact::measure
