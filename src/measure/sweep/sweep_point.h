#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/sweep/sweep_plan.h"

namespace myotact::measure {

/// What was found at a point: one number a quantity, NaN where there is none.
struct SweepResult {
  std::vector<double> quantities;
  std::string error;  // why the point could not be computed; empty: it was
};

/// Loads the point's scene and measures what the quantities ask for: "stiffness." the row that `myotact stiffness`
/// gives at the scene's own angle and level, "run." what the script does in lockstep. A scene that cannot be is a
/// result with its error. Throws Error BadData for a quantity that is not there.
SweepResult measure_point(const SweepPlan& plan, const std::vector<double>& values, int workers);

/// "point_000012.json", counted from 0.
std::string point_file_name(int point);
std::string point_json(const SweepPlan& plan, int point, const SweepResult& result);
/// Nothing where there is no such file. Throws Error BadData for a file of another sweep, or one that was edited.
std::optional<SweepResult> read_point(const SweepPlan& plan, int point, const std::filesystem::path& folder);

/// One row a point in their order: point, keys, quantities, error.
std::string sweep_csv(const SweepPlan& plan, const std::vector<SweepResult>& results);

}  // namespace myotact::measure
