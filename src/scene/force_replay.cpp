#include "scene/force_replay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/lockstep_haptics.h"
#include "scene/model_writer.h"
#include "scene/tool_choice.h"

namespace myotact::scene {

namespace {

std::vector<messages::DeviceState> device_states(const std::vector<TickRecord>& ticks) {
  std::vector<messages::DeviceState> states;
  states.reserve(ticks.size());
  for (const TickRecord& tick : ticks) states.push_back(tick.device);
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

ToolReplay::ToolReplay(const Scene& scene, const Recording& recording, const device::DeviceProfile& device,
                       std::size_t tool)
    : recording_(recording),
      tool_(tool),
      step_ns_(static_cast<std::uint64_t>(std::llround(scene.settings.dt_s * 1e9))),
      settings_(scene.tools[tool]),
      device_(device_states(recording.tools[tool].ticks), device),
      loop_(device_, haptic_settings(scene.tools[tool])) {
  const std::vector<TickRecord>& ticks = recording.tools[tool].ticks;
  loop_.prepare(ticks.empty() ? 0 : ticks.front().time_ns);
}

void ToolReplay::feel(const simulation::Simulation& simulation) {
  const std::vector<ModelRecord>& models = recording_.tools[tool_].models;
  const std::vector<TickRecord>& ticks = recording_.tools[tool_].ticks;
  for (; next_model_ < models.size() && models[next_model_].step == steps_felt_; ++next_model_) {
    publish(models[next_model_], simulation);
    for (; next_tick_ < ticks.size() && ticks[next_tick_].model_sequence <= models[next_model_].sequence;
         ++next_tick_) {
      tick(ticks[next_tick_]);
    }
  }
  ++steps_felt_;
}

void ToolReplay::publish(const ModelRecord& record, const simulation::Simulation& simulation) {
  messages::ToolState state;  // before the first step the hand touches nothing
  state.tool_position_world_m = state.proxy_position_world_m = record.tool_position_world_m;
  if (record.step > 0) state = recording_.steps[record.step - 1].tools[tool_];
  const double radius_m = report_radius_m(with_choice(settings_, record.chosen));
  write_model(simulation, {state, static_cast<int>(tool_), record, step_ns_, radius_m}, loop_.models().back());
  loop_.models().publish();
}

void ToolReplay::tick(const TickRecord& record) {
  const bool stopped = loop_.gate_state() == haptics::GateState::Off;
  if (record.forces_stopped != stopped || next_tick_ == 0) loop_.stop_forces(record.forces_stopped);
  loop_.chosen_tools().publish(tool_in_hand(settings_, record.chosen));
  loop_.tick(record.time_ns);
  const messages::ToolState& felt = loop_.tool_state();
  const std::vector<StepRecord>& steps = recording_.steps;
  for (; next_step_ < steps.size() && steps[next_step_].tools[tool_].sequence <= felt.sequence; ++next_step_) {
    const messages::ToolState& recorded = steps[next_step_].tools[tool_];
    if (recorded.sequence != felt.sequence) continue;
    ++comparison_.compared;
    comparison_.largest_difference_N = std::max(comparison_.largest_difference_N, difference_N(felt, recorded));
    comparison_.largest_force_N = std::max(comparison_.largest_force_N, to_vec3(felt.force_world_N).norm());
  }
}

ForceReplay::ForceReplay(const Scene& scene, const Recording& recording,
                         const std::vector<device::DeviceProfile>& devices) {
  for (std::size_t t = 0; t < recording.tools.size(); ++t) {
    const device::DeviceProfile device = t < devices.size() ? devices[t] : device::DeviceProfile{};
    tools_.push_back(std::make_unique<ToolReplay>(scene, recording, device, t));
  }
}

void ForceReplay::feel(const simulation::Simulation& simulation) {
  for (const auto& tool : tools_) tool->feel(simulation);
}

ForceComparison ForceReplay::comparison() const {
  ForceComparison all;
  for (const auto& tool : tools_) {
    const ForceComparison& one = tool->comparison();
    all.compared += one.compared;
    all.largest_difference_N = std::max(all.largest_difference_N, one.largest_difference_N);
    all.largest_force_N = std::max(all.largest_force_N, one.largest_force_N);
  }
  return all;
}

}  // namespace myotact::scene
