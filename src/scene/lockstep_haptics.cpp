#include "scene/lockstep_haptics.h"

#include <cmath>

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
  settings.force_scale = tool.force_scale;
  settings.gate.force_limit = tool.force_limit;
  settings.texture = tool.texture;
  return settings;
}

LockstepHaptics::LockstepHaptics(device::Device& device, const Scene& scene)
    : step_ns_(static_cast<std::uint64_t>(std::llround(scene.settings.dt_s * 1e9))),
      loop_(device, haptic_settings(scene.tools.front())) {
  loop_.prepare(clock_ns_);
}

int LockstepHaptics::ticks_a_step() const {
  return static_cast<int>((step_ns_ + haptics::kTickPeriod_ns / 2) / haptics::kTickPeriod_ns);
}

double LockstepHaptics::time_s() const {
  return static_cast<double>(clock_ns_ - haptics::kTickPeriod_ns) / 1e9;  // by division: the nearest to whole ms
}

void LockstepHaptics::tick() {
  loop_.tick(clock_ns_);
  clock_ns_ += haptics::kTickPeriod_ns;
  for (haptics::HapticTick tick; loop_.ticks().pop(tick);) {  // nobody else empties the queue here
  }
}

ModelRecord LockstepHaptics::publish_model(const simulation::Simulation& simulation) {
  const messages::ToolState& tool = loop_.tool_state();
  const ModelRecord record{++model_sequence_, clock_ns_, false, tool.tool_position_world_m, 0};
  write_model(simulation, tool, record, step_ns_, loop_.models().back());
  loop_.models().publish();
  return record;
}

}  // namespace myotact::scene
