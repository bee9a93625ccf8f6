#pragma once

#include <string>
#include <vector>

#include "core/vector.h"
#include "measure/fidelity/force_comparison.h"

namespace myotact::measure {

/// Faults that are put into a commanded force to see whether the comparison finds them. They act on the force as it was
/// recorded, in the analysis: neither the device nor the run knows of them.
struct PlantedFaults {
  double delay_s = 0.0;     // 0 .. 0.05
  double scale = 1.0;       // 0.5 .. 2
  double rotate_rad = 0.0;  // -0.5 .. 0.5, about an axis across the mean of the forces: every degree of it shows
  double noise_N = 0.0;     // 0 .. 1, white, root mean square of the vector

  bool any() const { return delay_s != 0.0 || scale != 1.0 || rotate_rad != 0.0 || noise_N != 0.0; }
};

/// From "delay_ms=5,scale=0.9,rotate_deg=5,noise_mN=20", any of them. Throws Error Usage naming what is wrong.
PlantedFaults parse_planted_faults(const std::string& text);

/// The forces late, scaled, rotated and noisy, in that order. Same arguments, same bits.
std::vector<Vec3> plant(const PlantedFaults& faults, const std::vector<Vec3>& force_N);

/// What a comparison finds of faults that were planted into a series, beyond what the series had before: lags
/// subtracted, gains divided, rotations undone, noise less the square of the noise there was.
PlantedFaults found_faults(const ForceComparison& before, const ForceComparison& after);

/// What planted faults were, and what was found of them.
struct PlantedReport {
  PlantedFaults planted;
  PlantedFaults alone;     // the force with the faults beside the same force without: nothing else differs
  PlantedFaults on_truth;  // beside the truth, less what it differs by anyway
  /// Whether `alone` holds each within a tenth of what was planted.
  bool all_found() const;
};

/// Plants into the commanded force of a series and compares.
PlantedReport report_planted(const ForceSeries& series, const PlantedFaults& faults);

}  // namespace myotact::measure
