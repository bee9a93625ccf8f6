#include "measure/fidelity/true_force.h"

#include <algorithm>
#include <cstdint>

#include "device/replay_device.h"
#include "haptics/gate/stiffness_bound.h"
#include "scene/conductor.h"
#include "scene/lockstep_haptics.h"

namespace myotact::measure {

namespace {

/// The stiffest coupling that the haptic loop itself uses (contact_compliance.cpp): tissue of 1000 N/m reads 3 % soft.
constexpr double kCoupling_N_m = 3e4;
constexpr double kNoLimit_N = 1e3;  // above any device's

device::DeviceProfile unlimited(device::DeviceProfile profile) {
  profile.peak_force_N = profile.continuous_force_N = kNoLimit_N;
  return profile;
}

haptics::HapticSettings true_settings(const scene::Scene& scene, const device::DeviceProfile& profile) {
  haptics::HapticSettings settings = scene::haptic_settings(scene.tools.front());
  settings.limit_stiffness = false;
  settings.contact.stiffness_N_m = kCoupling_N_m;
  settings.contact.damping_Ns_m = 0.0;
  settings.bone.stiffness_N_m = std::min(settings.bone.stiffness_N_m, haptics::stiffness_bound(profile).smallest_N_m());
  settings.bone.force_scale = settings.force_scale;
  return settings;
}

std::vector<messages::DeviceState> path_of(const DeviceRun& run) {
  std::vector<messages::DeviceState> path;
  for (std::size_t i = 0; i < run.ticks.size(); ++i) {
    path.push_back(run.ticks[i].device);
    path.back().stylus_position_world_m = to_array(run.hand_m[i]);
  }
  return path;
}

/// Without what swings from tick to tick: proxy and solver alternate, and where the tool slides the one answers to the
/// other's last force (80 mN on the canine triceps). Quarter, half, quarter is not late and takes all of that.
std::vector<Vec3> without_turns(const std::vector<Vec3>& force_N) {
  std::vector<Vec3> smooth_N = force_N;
  for (std::size_t i = 1; i + 1 < force_N.size(); ++i)
    smooth_N[i] = 0.25 * force_N[i - 1] + 0.5 * force_N[i] + 0.25 * force_N[i + 1];
  return smooth_N;
}

scene::Scene a_step_a_tick(scene::Scene scene) {
  scene.settings.dt_s = 1e-9 * static_cast<double>(haptics::kTickPeriod_ns);
  return scene;
}

}  // namespace

std::vector<Vec3> true_force_by_ticks(const scene::Scene& scene, const DeviceRun& run,
                                      const device::DeviceProfile& profile, const RunWatch& watch) {
  const scene::Scene fine = a_step_a_tick(scene);
  simulation::Simulation simulation(fine.specimen, fine.settings);
  const scene::Conductor start(fine, simulation);
  device::ReplayDevice device(path_of(run), unlimited(profile));
  haptics::HapticLoop loop(device, true_settings(scene, profile));
  std::uint64_t now_ns = haptics::kTickPeriod_ns;
  loop.prepare(now_ns);
  std::vector<Vec3> force_N;
  for (std::size_t k = 0; k < run.ticks.size(); ++k) {
    messages::LocalModel& model = loop.models().back();
    simulation.write_local_model(loop.tool_state(), model);
    if (k > 0) force_N.push_back(simulated_force_N(model, loop.tool_state(), scene.tools.front().force_scale));
    model.sequence = k + 1;
    model.dt_ns = haptics::kTickPeriod_ns;
    model.published_at_ns = now_ns - model.dt_ns;  // played to its end at once: where the tissue is now
    model.tool_sequence = loop.tool_state().sequence;
    loop.models().publish();
    if (watch.progress) watch.progress(static_cast<int>(k), static_cast<int>(run.ticks.size()));
    if (watch.stopped && watch.stopped()) return without_turns(force_N);
    loop.tick(now_ns);
    now_ns += haptics::kTickPeriod_ns;
    for (haptics::HapticTick tick; loop.ticks().pop(tick);) {  // the only reader of the queue
    }
    const scene::StepRecord& step = run.steps[run.step_of_tick[k]];
    std::vector<messages::ToolState> tools = step.tools;  // another hand holds what it held in that step
    tools.front() = loop.tool_state();
    scene::apply(step, simulation);
    simulation.step(tools);
  }
  messages::LocalModel& last = loop.models().back();
  simulation.write_local_model(loop.tool_state(), last);
  if (!run.ticks.empty())
    force_N.push_back(simulated_force_N(last, loop.tool_state(), scene.tools.front().force_scale));
  return without_turns(force_N);
}

std::vector<Vec3> true_force_by_steps(const DeviceRun& run) {
  std::vector<Vec3> force_N(run.ticks.size(), Vec3::Zero());
  std::size_t known = 0;  // tick of the last step's end
  Vec3 before_N = Vec3::Zero();
  for (std::size_t k = 0; k < run.ticks.size(); ++k) {
    const bool ends = k + 1 == run.ticks.size() || run.step_of_tick[k + 1] != run.step_of_tick[k];
    if (!ends) continue;
    const Vec3& here_N = run.step_force_N[run.step_of_tick[k]];
    for (std::size_t i = known; i <= k; ++i) {
      const double share = k == known ? 1.0 : static_cast<double>(i - known) / static_cast<double>(k - known);
      force_N[i] = before_N + share * (here_N - before_N);
    }
    before_N = here_N;
    known = k;
  }
  return force_N;
}

}  // namespace myotact::measure
