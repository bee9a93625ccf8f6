#include "scene/lockstep_session.h"

#include <cmath>

#include "haptics/haptic_thread.h"

namespace myotact::scene {

haptics::HapticSettings haptic_settings(const ToolSettings& tool) {
  haptics::HapticSettings settings;
  settings.contact.radius_m = tool.radius_m;
  settings.contact.stiffness_N_m = tool.stiffness_N_m;
  settings.contact.static_friction = tool.static_friction;
  settings.contact.dynamic_friction = tool.dynamic_friction;
  settings.force_scale = tool.force_scale;
  return settings;
}

LockstepSession::LockstepSession(const Scene& scene, simulation::Simulation& simulation, SampleTable& samples,
                                 RecordingWriter* recorder)
    : scene_(&scene),
      simulation_(&simulation),
      samples_(&samples),
      recorder_(recorder),
      conductor_(scene, simulation),
      device_(scene.tools.front().device, conductor_.hand(0.0).position_world_m),
      loop_(device_, haptic_settings(scene.tools.front())) {
  clock_ns_ = haptics::kTickPeriod_ns;  // time 0 means "never" to a device
  loop_.prepare(clock_ns_);
  publish_model();
}

void LockstepSession::publish_model() {
  messages::LocalModel& model = loop_.models().back();
  simulation_->write_local_model(loop_.tool_state(), model);
  model.sequence = ++model_sequence_;
  model.published_at_ns = clock_ns_;
  model.dt_ns = static_cast<std::uint64_t>(std::llround(scene_->settings.dt_s * 1e9));
  model.tool_sequence = loop_.tool_state().sequence;
  loop_.models().publish();
}

void LockstepSession::run_ticks() {
  const auto ticks =
      static_cast<int>(std::llround(scene_->settings.dt_s * 1e9 / static_cast<double>(haptics::kTickPeriod_ns)));
  for (int i = 0; i < ticks; ++i) {
    const double time_s =
        static_cast<double>(clock_ns_ - haptics::kTickPeriod_ns) / 1e9;  // by division: the nearest to whole ms
    const HandTarget hand = conductor_.hand(time_s);
    device_.set_hand_target({to_array(hand.position_world_m), {}, hand.buttons});
    loop_.tick(clock_ns_);
    const haptics::HapticTick& tick = loop_.last_tick();
    samples_->add(time_s, tick.tool, tick.line_tension_N, *simulation_);
    extremes_.add_tick(tick);
    if (recorder_ != nullptr) ticks_.push_back({tick.device, tick.model_sequence});
    clock_ns_ += haptics::kTickPeriod_ns;
  }
  for (haptics::HapticTick tick; loop_.ticks().pop(tick);) {  // nobody else empties the queue here
  }
}

void LockstepSession::step() {
  conductor_.prepare_step(simulation_->time_s(), input_);
  run_ticks();
  input_.tool = loop_.tool_state();
  apply(input_, *simulation_);
  simulation_->step({&input_.tool, 1});
  extremes_.add_step(*scene_, *simulation_);
  publish_model();
  if (recorder_ == nullptr) return;
  input_.state_hash = simulation_->state_hash();
  recorder_->add(ticks_);
  recorder_->add(input_);
  ticks_.clear();
}

}  // namespace myotact::scene
