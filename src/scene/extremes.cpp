#include "scene/extremes.h"

#include <algorithm>
#include <cmath>

namespace myotact::scene {

void Extremes::add_tick(std::size_t tool, const haptics::HapticTick& tick) {
  constexpr double kTick_s = 1e-9 * static_cast<double>(haptics::kTickPeriod_ns);
  ToolExtremes& reached = tools[tool];
  reached.force_N = std::max(reached.force_N, to_vec3(tick.tool.force_world_N).norm());
  reached.line_tension_N = std::max(reached.line_tension_N, tick.line_tension_N);
  if (tick.tool.contact.surface >= 0) reached.contact_s += kTick_s;
  if (tick.tool.grabbed_body >= 0) reached.bone_s += kTick_s;
  reached.faults |= tick.tool.faults;
}

void Extremes::add_step(const Scene& scene, const simulation::Simulation& simulation) {
  residual_share = std::max(residual_share, simulation.residual_share());
  for (int m = 0; m < static_cast<int>(scene.specimen.muscles.size()); ++m) {
    volume_error = std::max(volume_error, std::abs(simulation.volume_ratio(m) - 1.0));
    asleep += simulation.asleep(m);
    smallest_J = std::min(smallest_J, simulation.smallest_volume_ratio(m));
  }
  if (!scene.co_contraction) return;
  const int joint = scene.co_contraction->joint;
  const double start_rad = scene.joints[static_cast<std::size_t>(joint)].angle_rad;
  drift_rad = std::max(drift_rad, std::abs(simulation.joint(joint).angle_rad - start_rad));
}

}  // namespace myotact::scene
