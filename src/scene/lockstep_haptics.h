#pragma once

#include <cstdint>
#include <string>

#include "device/device.h"
#include "haptics/haptic_loop.h"
#include "scene/recording.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// Settings of a scene's tool for its haptic loop.
haptics::HapticSettings haptic_settings(const ToolSettings& tool);

/// A haptic loop on the virtual clock:  ticks of a step --> step (the caller's) --> publish_model --> ticks ...
class LockstepHaptics {
 public:
  /// `device` outlives this. Opens it. The first model is to be published before the first tick.
  LockstepHaptics(device::Device& device, const Scene& scene);

  int ticks_a_step() const;
  double time_s() const;  // of the next tick
  void tick();
  /// The state after a step, felt from the next tick on.
  ModelRecord publish_model(const simulation::Simulation& simulation);

  const haptics::HapticTick& last_tick() const { return loop_.last_tick(); }
  const messages::ToolState& tool() const { return loop_.tool_state(); }
  const std::string& notice() const { return loop_.notice(); }  // what the device does not bear of the settings

 private:
  std::uint64_t step_ns_;
  haptics::HapticLoop loop_;
  std::uint64_t clock_ns_ = haptics::kTickPeriod_ns;  // time 0 means "never" to a device
  std::uint64_t model_sequence_ = 0;
};

}  // namespace myotact::scene
