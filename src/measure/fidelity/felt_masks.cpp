#include "measure/fidelity/felt_masks.h"

namespace myotact::measure {

namespace {

constexpr std::size_t kHandMoves_ticks = 120;  // 100 ms (muscle_line_drag, bone_drag) and two steps for the simulation

}  // namespace

ComparedTicks compared_ticks(const scene::Scene& scene, const DeviceRun& run, const device::DeviceProfile& profile,
                             const std::vector<Vec3>& true_N) {
  const double limit_N = profile.peak_force_N * scene.tools.front().force_limit;
  ComparedTicks result;
  std::size_t since_hand = kHandMoves_ticks;
  for (std::size_t i = 0; i < true_N.size(); ++i) {
    const haptics::HapticTick& tick = run.ticks[i];
    const bool changed = i > 0 && (tick.tool.grabbed_line != run.ticks[i - 1].tool.grabbed_line ||
                                   tick.tool.grabbed_body != run.ticks[i - 1].tool.grabbed_body);
    since_hand = changed ? 0 : since_hand + 1;
    const bool shut = tick.gate != haptics::GateState::On;
    const bool moves = since_hand < kHandMoves_ticks;
    const bool limited = true_N[i].norm() >= limit_N;
    result.gate += shut ? 1 : 0;
    result.hand += !shut && moves ? 1 : 0;
    result.at_limit += !shut && !moves && limited ? 1 : 0;
    result.compared.push_back(!shut && !moves && !limited);
    if (changed) result.compared[i - 1] = false;  // the truth is smoothed over its neighbours
  }
  return result;
}

ForceSeries felt_series(const DeviceRun& run, const std::vector<Vec3>& true_N, const std::vector<bool>& compared) {
  ForceSeries series;
  series.true_N = true_N;
  series.compared = compared;
  const std::size_t ticks = true_N.size();  // fewer than of the run when stopped
  for (std::size_t i = 0; i < ticks; ++i) {
    series.commanded_N.push_back(to_vec3(run.ticks[i].tool.force_world_N));
    series.hand_m.push_back(to_vec3(run.ticks[i].device.stylus_position_world_m));
  }
  return series;
}

}  // namespace myotact::measure
