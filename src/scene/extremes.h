#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "haptics/haptic_loop.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// What one tool reached in a run.
struct ToolExtremes {
  double force_N = 0.0;         // on the hand
  double line_tension_N = 0.0;  // of the line in hand
  double contact_s = 0.0;       // time in which a surface was touched
  double bone_s = 0.0;          // time in which a bone was in hand
  std::uint64_t faults = 0;     // haptics::Fault bits
};

/// What a run reached, for its summary.
struct Extremes {
  explicit Extremes(std::size_t tool_count = 1) : tools(tool_count) {}

  std::vector<ToolExtremes> tools;
  double drift_rad = 0.0;       // of the co-contraction joint from its starting angle
  double residual_share = 0.0;  // out-of-balance force of a step over the size of the forces
  double volume_error = 0.0;    // |V / V at rest - 1| of a whole muscle
  double smallest_J = 1.0;      // over all integration points of the muscles
  std::uint64_t asleep = 0;     // muscles not solved for since nothing moved them, summed over the steps

  void add_tick(std::size_t tool, const haptics::HapticTick& tick);
  void add_step(const Scene& scene, const simulation::Simulation& simulation);
};

}  // namespace myotact::scene
