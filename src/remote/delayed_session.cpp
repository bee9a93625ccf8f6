#include "remote/delayed_session.h"

#include <cmath>

#include "layer/simulation_engine.h"
#include "scene/lockstep_haptics.h"
#include "scene/model_writer.h"

namespace myotact::remote {

DelayedLink symmetric_link(double round_trip_s, double jitter_s, double stalls_per_s, std::uint64_t seed) {
  DelayedLink link;
  link.up = {0.5 * round_trip_s, jitter_s, stalls_per_s, 0.1, 2 * seed};
  link.down = {0.5 * round_trip_s, jitter_s, stalls_per_s, 0.1, 2 * seed + 1};
  return link;
}

DelayedSession::DelayedSession(const scene::Scene& scene, simulation::Simulation& simulation, const DelayedLink& link)
    : scene_(&scene),
      simulation_(&simulation),
      conductor_(scene, simulation),
      device_(scene.tools.front().device, conductor_.hand(0, 0.0).position_world_m),
      loop_(device_, scene::haptic_settings(scene.tools.front())),
      up_(link.up),
      down_(link.down),
      step_ns_(static_cast<std::uint64_t>(std::llround(scene.settings.dt_s * 1e9))),
      ticks_a_step_((step_ns_ + haptics::kTickPeriod_ns / 2) / haptics::kTickPeriod_ns) {
  loop_.prepare(clock_ns_);
  arrived_ = loop_.tool_state();
  send_model();
}

double DelayedSession::time_s() const {
  return static_cast<double>(clock_ns_ - haptics::kTickPeriod_ns) / 1e9;
}

void DelayedSession::take_arrivals() {
  if (const messages::LocalModel* model = down_.receive(clock_ns_)) {
    loop_.models().back() = *model;
    loop_.models().publish();
  }
}

void DelayedSession::tick(const device::HandTarget& hand) {
  if (ticks_ % ticks_a_step_ == 0) conductor_.prepare_step(simulation_->time_s(), input_);
  take_arrivals();
  device_.set_hand_target(hand);
  loop_.tick(clock_ns_);
  for (haptics::HapticTick tick; loop_.ticks().pop(tick);) {  // the only reader of the queue
  }
  up_.send(clock_ns_, loop_.tool_state());
  if (const messages::ToolState* state = up_.receive(clock_ns_)) arrived_ = *state;
  clock_ns_ += haptics::kTickPeriod_ns;
  if (++ticks_ % ticks_a_step_ == 0) step();
}

void DelayedSession::step() {
  input_.tools.assign(1, arrived_);
  layer::name_touched_triangle(*simulation_, input_.tools.front());
  scene::apply(input_, *simulation_);
  simulation_->step(input_.tools);
  send_model();
}

void DelayedSession::send_model() {
  const scene::ModelRecord record{++model_sequence_, clock_ns_, false, arrived_.tool_position_world_m, 0};
  const double radius_m = scene::report_radius_m(scene_->tools.front());
  scene::write_model(*simulation_, {arrived_, 0, record, step_ns_, radius_m}, model_);
  down_.send(clock_ns_, model_);
}

}  // namespace myotact::remote
