#include "scene/lockstep_haptics.h"

#include <cmath>

#include "haptics/haptic_group.h"
#include "scene/model_writer.h"

namespace myotact::scene {

haptics::HapticSettings haptic_settings(const ToolSettings& tool) {
  haptics::HapticSettings settings;
  settings.method = tool.method;
  settings.contact.radius_m = tool.radius_m;
  settings.contact.stiffness_N_m = tool.stiffness_N_m;
  settings.contact.static_friction = tool.static_friction;
  settings.contact.dynamic_friction = tool.dynamic_friction;
  settings.contact.stribeck_m_s = tool.stribeck_m_s;
  settings.contact.along_over_across = tool.along_over_across;
  settings.contact.viscous_Ns_m = tool.viscous_Ns_m;
  settings.snap.force_N = tool.line_snap_N;
  settings.shape = tool.shape;
  settings.force_scale = tool.force_scale;
  settings.gate.force_limit = tool.force_limit;
  settings.texture = tool.texture;
  return settings;
}

std::string stiffness_notices(std::span<haptics::HapticLoop* const> loops, const Scene& scene) {
  std::string notices;
  for (std::size_t t = 0; t < loops.size(); ++t) {
    if (loops[t]->notice().empty()) continue;
    if (!notices.empty()) notices += '\n';
    if (loops.size() > 1) notices += scene.tools[t].hand + " hand: ";
    notices += loops[t]->notice();
  }
  return notices;
}

LockstepHaptics::LockstepHaptics(std::span<device::Device* const> devices, const Scene& scene)
    : step_ns_(static_cast<std::uint64_t>(std::llround(scene.settings.dt_s * 1e9))), model_sequences_(devices.size()) {
  for (std::size_t t = 0; t < devices.size(); ++t) {
    owned_.push_back(std::make_unique<haptics::HapticLoop>(*devices[t], haptic_settings(scene.tools[t])));
    loops_.push_back(owned_.back().get());
    report_radii_m_.push_back(report_radius_m(scene.tools[t]));
    loops_.back()->prepare(clock_ns_);
  }
  notice_ = stiffness_notices(loops_, scene);
}

int LockstepHaptics::ticks_a_step() const {
  return static_cast<int>((step_ns_ + haptics::kTickPeriod_ns / 2) / haptics::kTickPeriod_ns);
}

double LockstepHaptics::time_s() const {
  return static_cast<double>(clock_ns_ - haptics::kTickPeriod_ns) / 1e9;  // by division: the nearest to whole ms
}

void LockstepHaptics::tick() {
  haptics::tick_all(loops_, clock_ns_);
  clock_ns_ += haptics::kTickPeriod_ns;
  for (haptics::HapticLoop* loop : loops_) {
    for (haptics::HapticTick tick; loop->ticks().pop(tick);) {  // the only reader of the queue
    }
  }
}

ModelRecord LockstepHaptics::publish_model(std::size_t tool, const simulation::Simulation& simulation) {
  haptics::HapticLoop& loop = *loops_[tool];
  const messages::ToolState& state = loop.tool_state();
  const ModelRecord record{++model_sequences_[tool], clock_ns_, false, state.tool_position_world_m, 0};
  write_model(simulation, {state, static_cast<int>(tool), record, step_ns_, report_radii_m_[tool]},
              loop.models().back());
  loop.models().publish();
  return record;
}

}  // namespace myotact::scene
