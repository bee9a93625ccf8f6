#include "scene/lockstep_session.h"

namespace myotact::scene {

LockstepSession::LockstepSession(const Scene& scene, simulation::Simulation& simulation, SampleTable& samples,
                                 RecordingWriter* recorder)
    : scene_(&scene),
      simulation_(&simulation),
      samples_(&samples),
      recorder_(recorder),
      conductor_(scene, simulation),
      device_(scene.tools.front().device, conductor_.hand(0.0).position_world_m),
      haptics_(device_, scene) {
  publish_model();
}

void LockstepSession::publish_model() {
  const ModelRecord model = haptics_.publish_model(*simulation_);
  if (recorder_ != nullptr) recorder_->add(model);
}

void LockstepSession::run_ticks() {
  for (int i = 0; i < haptics_.ticks_a_step(); ++i) {
    const double time_s = haptics_.time_s();
    const HandTarget hand = conductor_.hand(time_s);
    device_.set_hand_target({to_array(hand.position_world_m), {}, hand.buttons});
    haptics_.tick();
    const haptics::HapticTick& tick = haptics_.last_tick();
    samples_->add(time_s, tick.tool, tick.line_tension_N, *simulation_);
    extremes_.add_tick(tick);
    if (recorder_ != nullptr) ticks_.push_back(record_of(tick));
  }
}

void LockstepSession::step() {
  conductor_.prepare_step(simulation_->time_s(), input_);
  run_ticks();
  input_.tool = haptics_.tool();
  apply(input_, *simulation_);
  simulation_->step({&input_.tool, 1});
  extremes_.add_step(*scene_, *simulation_);
  if (recorder_ != nullptr) {
    input_.state_hash = simulation_->state_hash();
    recorder_->add(ticks_);
    recorder_->add(input_);
    ticks_.clear();
  }
  publish_model();
}

}  // namespace myotact::scene
