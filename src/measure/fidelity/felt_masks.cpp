#include "measure/fidelity/felt_masks.h"

namespace myotact::measure {

namespace {

constexpr std::size_t kHandMoves_ticks = 120;  // 100 ms (muscle_line_drag, bone_drag) and two steps for the simulation
constexpr double kAtLimit = 0.98;              // of the limit: below it the gate cut nothing

}  // namespace

JudgedTicks judged_ticks(const scene::Scene& scene, const DeviceRun& run, const device::DeviceProfile& profile) {
  const double limit_N = kAtLimit * profile.peak_force_N * scene.tools.front().force_limit;
  JudgedTicks result;
  std::size_t since_hand = kHandMoves_ticks;
  for (std::size_t i = 0; i < run.ticks.size(); ++i) {
    const haptics::HapticTick& tick = run.ticks[i];
    const bool changed = i > 0 && (tick.tool.grabbed_line != run.ticks[i - 1].tool.grabbed_line ||
                                   tick.tool.grabbed_body != run.ticks[i - 1].tool.grabbed_body);
    since_hand = changed ? 0 : since_hand + 1;
    const bool shut = tick.gate != haptics::GateState::On;
    const bool moves = since_hand < kHandMoves_ticks;
    const bool limited = to_vec3(tick.tool.force_world_N).norm() >= limit_N;
    result.gate += shut ? 1 : 0;
    result.hand += !shut && moves ? 1 : 0;
    result.at_limit += !shut && !moves && limited ? 1 : 0;
    result.judged.push_back(!shut && !moves && !limited);
  }
  return result;
}

}  // namespace myotact::measure
