#include "measure/fidelity/device_run.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "device/simulated_device.h"
#include "scene/force_replay.h"
#include "scene/lockstep_haptics.h"

namespace myotact::measure {

namespace {

/// Keeps what a step gave.
class StepBook {
 public:
  explicit StepBook(const scene::Scene& scene)
      : joint_(scene.co_contraction ? scene.co_contraction->joint : -1),
        force_scale_(scene.tools.front().force_scale),
        model_(std::make_unique<messages::LocalModel>()) {}

  void add(const scene::StepRecord& input, const simulation::Simulation& simulation, DeviceRun& run) {
    const messages::ToolState& measured = input.tools.front();
    simulation.write_local_model(measured, *model_);
    run.steps.push_back(input);
    run.step_force_N.push_back(simulated_force_N(*model_, measured, force_scale_));
    if (joint_ >= 0) run.joints.push_back(simulation.joint(joint_));
  }

 private:
  int joint_;
  double force_scale_;
  std::unique_ptr<messages::LocalModel> model_;
};

/// Ticks of a hand that waits where the script begins until the force gate has opened: 1 s of ramp and some.
constexpr int kGateOpens_ticks = 1200;

/// Recorded positions without the encoder's counts: mean under Hann's window, not late.
std::vector<Vec3> smoothed_path_m(const std::vector<haptics::HapticTick>& ticks) {
  constexpr long kHalf_ticks = 5;
  std::vector<Vec3> path_m;
  const auto count = static_cast<long>(ticks.size());
  for (long i = 0; i < count; ++i) {
    const long half = std::min({kHalf_ticks, i, count - 1 - i});
    Vec3 sum_m = Vec3::Zero();
    double weight = 0.0;
    for (long k = -half; k <= half; ++k) {
      const double share = 1.0 + std::cos(std::numbers::pi * static_cast<double>(k) / static_cast<double>(half + 1));
      sum_m += share * to_vec3(ticks[static_cast<std::size_t>(i + k)].device.stylus_position_world_m);
      weight += share;
    }
    path_m.emplace_back(sum_m / weight);
  }
  return path_m;
}

/// A simulated device a tool, all of the same profile.
struct ScriptedDevices {
  ScriptedDevices(const HandPath& hand_path, std::size_t count, const device::DeviceProfile& profile)
      : path(hand_path) {
    for (std::size_t t = 0; t < count; ++t) {
      owned.push_back(
          std::make_unique<device::SimulatedDevice>("simulated", path.hand(t, 0.0).position_world_m, profile));
      pointers.push_back(owned.back().get());
    }
  }
  void aim(double time_s) {
    for (std::size_t t = 0; t < owned.size(); ++t) {
      const scene::HandTarget hand = path.hand(t, time_s);
      owned[t]->set_hand_target({to_array(hand.position_world_m), {}, hand.buttons});
    }
  }

  const HandPath& path;
  std::vector<std::unique_ptr<device::SimulatedDevice>> owned;
  std::vector<device::Device*> pointers;
};

void publish_models(const simulation::Simulation& simulation, scene::LockstepHaptics& haptics) {
  for (std::size_t t = 0; t < haptics.tool_count(); ++t) haptics.publish_model(t, simulation);
}

/// Ticks of a resting hand until the force gate has opened, on models of a simulation that stands still.
void open_gate(const simulation::Simulation& simulation, scene::LockstepHaptics& haptics) {
  publish_models(simulation, haptics);
  for (int i = 0; i < kGateOpens_ticks; ++i) {
    haptics.tick();
    if ((i + 1) % haptics.ticks_a_step() == 0) publish_models(simulation, haptics);
  }
}

bool goes_on(const RunWatch& watch, std::size_t done, std::size_t all) {
  if (watch.progress) watch.progress(static_cast<int>(done), static_cast<int>(all));
  return !watch.stopped || !watch.stopped();
}

}  // namespace

scene::Scene without_effects(scene::Scene scene) {
  for (scene::ToolSettings& tool : scene.tools) {
    tool.texture = {};
    tool.line_snap_N = 0.0;
  }
  return scene;
}

Vec3 simulated_force_N(const messages::LocalModel& model, const messages::ToolState& tool, double force_scale) {
  Vec3 on_hand_N = Vec3::Zero();
  if (model.contact.surface >= 0) on_hand_N -= to_vec3(model.contact.force_world_N);
  if (tool.grabbed_body >= 0 && model.grip.body == tool.grabbed_body) on_hand_N -= to_vec3(model.grip.force_world_N);
  if (tool.grabbed_line >= 0 && model.line.muscle == tool.grabbed_line) {
    const Vec3 hand_m = to_vec3(tool.tool_position_world_m);
    const Vec3 along = (to_vec3(model.line.proximal_point_world_m) - hand_m).normalized() +
                       (to_vec3(model.line.distal_point_world_m) - hand_m).normalized();
    on_hand_N += model.line.tension_N * along;
  }
  return force_scale * on_hand_N;
}

DeviceRun run_along(const StandingScene& standing, const device::DeviceProfile& profile, const HandPath& path,
                    const RunWatch& watch) {
  const auto& [scene, simulation, conductor] = standing;
  ScriptedDevices devices(path, scene.tools.size(), profile);
  scene::LockstepHaptics haptics(devices.pointers, scene);
  devices.aim(0.0);
  open_gate(simulation, haptics);
  const double start_s = haptics.time_s();
  StepBook book(scene);
  DeviceRun run;
  run.notice = haptics.notice();
  const auto steps = static_cast<std::size_t>(std::llround(path.end_s / scene.settings.dt_s));
  scene::StepRecord input;
  for (std::size_t step = 0; step < steps && goes_on(watch, step, steps); ++step) {
    conductor.prepare_step(simulation.time_s(), input);
    for (int i = 0; i < haptics.ticks_a_step(); ++i) {
      devices.aim(haptics.time_s() - start_s);
      haptics.tick();
      run.ticks.push_back(haptics.last_tick(0));
      run.hand_m.push_back(devices.owned.front()->position_world_m());
      run.step_of_tick.push_back(step);
    }
    input.tools.clear();
    for (std::size_t t = 0; t < haptics.tool_count(); ++t) input.tools.push_back(haptics.last_tick(t).tool);
    scene::apply(input, simulation);
    simulation.step(input.tools);
    book.add(input, simulation, run);
    publish_models(simulation, haptics);
  }
  return run;
}

DeviceRun run_scripted(const scene::Scene& scene, const device::DeviceProfile& profile, double seconds,
                       const RunWatch& watch) {
  simulation::Simulation simulation(scene.specimen, scene.settings);
  scene::Conductor conductor(scene, simulation);
  const HandPath path{[&](std::size_t tool, double time_s) { return conductor.hand(tool, time_s); },
                      std::min(seconds, conductor.script_end_s())};
  return run_along({scene, simulation, conductor}, profile, path, watch);
}

DeviceRun run_recorded(const scene::Scene& scene, const scene::Recording& recording,
                       const device::DeviceProfile& profile, const RunWatch& watch) {
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const scene::Conductor start(scene, simulation);  // puts the simulation where the recording began
  scene::ForceReplay replay(scene, recording, std::vector(scene.tools.size(), profile));
  StepBook book(scene);
  DeviceRun run;
  const std::size_t steps = recording.steps.size();
  for (std::size_t step = 0; step < steps && goes_on(watch, step, steps); ++step) {
    replay.feel(simulation);
    for (haptics::HapticTick tick; replay.tool_count() > 0 && replay.ticks(0).pop(tick);) {
      run.ticks.push_back(tick);
      run.step_of_tick.push_back(step);
    }
    scene::apply(recording.steps[step], simulation);
    simulation.step(recording.steps[step].tools);
    book.add(recording.steps[step], simulation, run);
  }
  run.hand_m = smoothed_path_m(run.ticks);
  return run;
}

}  // namespace myotact::measure
