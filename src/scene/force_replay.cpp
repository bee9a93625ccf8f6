#include "scene/force_replay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/lockstep_haptics.h"
#include "scene/model_writer.h"

namespace myotact::scene {

namespace {

std::vector<messages::DeviceState> device_states(const Recording& recording) {
  std::vector<messages::DeviceState> states;
  states.reserve(recording.ticks.size());
  for (const TickRecord& tick : recording.ticks) states.push_back(tick.device);
  return states;
}

double difference_N(const messages::ToolState& a, const messages::ToolState& b) {
  double largest_N = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double here_N = std::abs(a.force_world_N[k] - b.force_world_N[k]);
    if (!std::isfinite(here_N)) return std::numeric_limits<double>::infinity();
    largest_N = std::max(largest_N, here_N);
  }
  return largest_N;
}

}  // namespace

ForceReplay::ForceReplay(const Scene& scene, const Recording& recording, const device::DeviceProfile& device)
    : recording_(recording),
      step_ns_(static_cast<std::uint64_t>(std::llround(scene.settings.dt_s * 1e9))),
      device_(device_states(recording), device),
      loop_(device_, haptic_settings(scene.tools.front())) {
  loop_.prepare(recording.ticks.empty() ? 0 : recording.ticks.front().time_ns);
}

void ForceReplay::feel(const simulation::Simulation& simulation) {
  const std::vector<ModelRecord>& models = recording_.models;
  const std::vector<TickRecord>& ticks = recording_.ticks;
  for (; next_model_ < models.size() && models[next_model_].step == steps_felt_; ++next_model_) {
    publish(models[next_model_], simulation);
    for (; next_tick_ < ticks.size() && ticks[next_tick_].model_sequence <= models[next_model_].sequence;
         ++next_tick_) {
      tick(ticks[next_tick_]);
    }
  }
  ++steps_felt_;
}

void ForceReplay::publish(const ModelRecord& record, const simulation::Simulation& simulation) {
  messages::ToolState tool;  // before the first step the hand touches nothing
  tool.tool_position_world_m = tool.proxy_position_world_m = record.tool_position_world_m;
  if (record.step > 0) tool = recording_.steps[record.step - 1].tool;
  write_model(simulation, tool, record, step_ns_, loop_.models().back());
  loop_.models().publish();
}

void ForceReplay::tick(const TickRecord& record) {
  const bool stopped = loop_.gate_state() == haptics::GateState::Off;
  if (record.forces_stopped != stopped || next_tick_ == 0) loop_.stop_forces(record.forces_stopped);
  loop_.tick(record.time_ns);
  const messages::ToolState& tool = loop_.tool_state();
  const std::vector<StepRecord>& steps = recording_.steps;
  for (; next_step_ < steps.size() && steps[next_step_].tool.sequence <= tool.sequence; ++next_step_) {
    if (steps[next_step_].tool.sequence != tool.sequence) continue;
    ++compared_;
    largest_difference_N_ = std::max(largest_difference_N_, difference_N(tool, steps[next_step_].tool));
    largest_force_N_ = std::max(largest_force_N_, to_vec3(tool.force_world_N).norm());
  }
}

}  // namespace myotact::scene
