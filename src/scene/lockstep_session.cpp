#include "scene/lockstep_session.h"

#include "device/profile_file.h"
#include "layer/simulation_engine.h"
#include "scene/tool_frame.h"

namespace myotact::scene {

namespace {

std::vector<std::unique_ptr<device::SimulatedDevice>> simulated_devices(const Scene& scene,
                                                                        const Conductor& conductor) {
  std::vector<std::unique_ptr<device::SimulatedDevice>> devices;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const std::string& name = scene.tools[t].device;
    devices.push_back(std::make_unique<device::SimulatedDevice>(name, conductor.hand(t, 0.0).position_world_m,
                                                                device::simulated_profile(name)));
  }
  return devices;
}

std::vector<device::Device*> pointers_to(const std::vector<std::unique_ptr<device::SimulatedDevice>>& devices) {
  std::vector<device::Device*> pointers;
  for (const auto& device : devices) pointers.push_back(device.get());
  return pointers;
}

}  // namespace

LockstepSession::LockstepSession(const Scene& scene, simulation::Simulation& simulation, SampleTable& samples,
                                 RecordingWriter* recorder)
    : scene_(&scene),
      simulation_(&simulation),
      samples_(&samples),
      recorder_(recorder),
      conductor_(scene, simulation),
      devices_(simulated_devices(scene, conductor_)),
      haptics_(pointers_to(devices_), scene),
      extremes_(scene.tools.size()),
      ticks_(scene.tools.size()) {
  publish_models();
}

void LockstepSession::publish_models() {
  for (std::size_t t = 0; t < haptics_.tool_count(); ++t) {
    const ModelRecord model = haptics_.publish_model(t, *simulation_);
    if (recorder_ != nullptr) recorder_->add(t, model);
  }
}

void LockstepSession::run_ticks() {
  std::vector<ToolSample> row(devices_.size());
  for (int i = 0; i < haptics_.ticks_a_step(); ++i) {
    const double time_s = haptics_.time_s();
    for (std::size_t t = 0; t < devices_.size(); ++t) {
      const HandTarget hand = conductor_.hand(t, time_s);
      devices_[t]->set_hand_target({to_array(hand.position_world_m), {}, hand.buttons});
    }
    haptics_.tick();
    for (std::size_t t = 0; t < devices_.size(); ++t) {
      const haptics::HapticTick& tick = haptics_.last_tick(t);
      row[t] = {tick.tool, tick.line_tension_N};
      extremes_.add_tick(t, tick);
      if (recorder_ != nullptr) ticks_[t].push_back(record_of(tick));
    }
    samples_->add(time_s, row, *simulation_);
  }
}

std::vector<messages::ToolFrame> LockstepSession::tool_frames() const {
  std::vector<messages::ToolFrame> frames;
  for (std::size_t t = 0; t < devices_.size(); ++t) {
    frames.push_back(tool_frame(haptics_.felt_tool(t), *scene_, t, *simulation_));
  }
  return frames;
}

void LockstepSession::step() {
  conductor_.prepare_step(simulation_->time_s(), input_);
  run_ticks();
  input_.tools.clear();
  for (std::size_t t = 0; t < devices_.size(); ++t) {
    input_.tools.push_back(tool(t));
    layer::name_touched_triangle(*simulation_, input_.tools.back());
  }
  apply(input_, *simulation_);
  simulation_->step(input_.tools);
  extremes_.add_step(*scene_, *simulation_);
  if (recorder_ != nullptr) {
    input_.state_hash = simulation_->state_hash();
    for (std::size_t t = 0; t < ticks_.size(); ++t) {
      recorder_->add(t, ticks_[t]);
      ticks_[t].clear();
    }
    recorder_->add(input_);
  }
  publish_models();
}

}  // namespace myotact::scene
