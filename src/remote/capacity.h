#pragma once

#include <cstddef>
#include <vector>

#include "scene/scene_file.h"

namespace myotact::remote {

/// How long a step takes on this machine while hands press.
struct LoadedStep {
  std::size_t hands = 0;  // that press at once
  double step_s = 0.0;    // median, wall clock
};

/// Steps of the scene at rest while 0, 1, 2, 4 ... hands press its soft muscles 3 mm deep at places all over them, none
/// of which feels anything; ends with the first that takes longer than `allowed_s`, or with `most` hands. On a
/// simulation of its own, which settles first: seconds. Empty for a scene without soft muscles.
std::vector<LoadedStep> measure_load(const scene::Scene& scene, double allowed_s, std::size_t most);

/// How many hands may press at once while steps take no longer than `allowed_s`: between the measured numbers along a
/// straight line, `most` where no step took longer.
std::size_t hands_borne(const std::vector<LoadedStep>& load, double allowed_s, std::size_t most);

}  // namespace myotact::remote
