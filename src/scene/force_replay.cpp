#include "scene/force_replay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace myotact::scene {

namespace {

std::vector<messages::DeviceState> device_states(const Recording& recording) {
  std::vector<messages::DeviceState> states;
  states.reserve(recording.ticks.size());
  for (const TickRecord& tick : recording.ticks) states.push_back(tick.device);
  return states;
}

}  // namespace

ForceReplay::ForceReplay(const Scene& scene, const Recording& recording, const simulation::Simulation& simulation)
    : simulation_(simulation),
      device_(device_states(recording), device::DeviceProfile{}),
      haptics_(device_, scene, simulation) {}

void ForceReplay::run_ticks() {
  for (int i = 0; i < haptics_.ticks_a_step(); ++i) haptics_.tick();
}

double force_difference_N(const messages::ToolState& a, const messages::ToolState& b) {
  double largest_N = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double difference_N = std::abs(a.force_world_N[k] - b.force_world_N[k]);
    if (!std::isfinite(difference_N)) return std::numeric_limits<double>::infinity();
    largest_N = std::max(largest_N, difference_N);
  }
  return largest_N;
}

}  // namespace myotact::scene
