#pragma once

#include "device/simulated_device.h"
#include "scene/conductor.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::remote {

/// A simulated device whose hand follows a scene's script far from the simulation: touches are laid out on the limb as
/// it is at the scene's beginning.
class ScriptedDevice {
 public:
  /// Builds and settles the limb, which takes seconds. `scene` outlives it. Throws Error.
  ScriptedDevice(const scene::Scene& scene, std::size_t tool);

  device::SimulatedDevice& device() { return device_; }
  double script_end_s() const { return conductor_.script_end_s(); }
  const simulation::Simulation& limb() const { return limb_; }  // at rest
  /// Begins the script's actions that are due in the step from `time_s` on.
  void begin_step(double time_s) { conductor_.prepare_step(time_s, unused_); }
  /// Where the hand goes now.
  void move_to(double time_s);

 private:
  std::size_t tool_;
  simulation::Simulation limb_;
  scene::Conductor conductor_;
  device::SimulatedDevice device_;
  scene::StepRecord unused_;
};

}  // namespace myotact::remote
