#pragma once

#include <cstdint>
#include <memory>

#include "device/simulated_device.h"
#include "scene/conductor.h"
#include "scene/extremes.h"
#include "scene/lockstep_haptics.h"
#include "scene/recording.h"
#include "scene/samples.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// Runs a scene on one virtual clock: the haptic ticks of a step, then the step, whose result is felt from then on.
/// Bit for bit the same on one build and machine, whatever the number of workers.
class LockstepSession {
 public:
  /// All references must outlive the session. `recorder` may be null. Throws Error.
  LockstepSession(const Scene& scene, simulation::Simulation& simulation, SampleTable& samples,
                  RecordingWriter* recorder);

  /// One simulation step and the haptic ticks before it.
  void step();

  Conductor& conductor() { return conductor_; }
  const messages::ToolState& tool() const { return haptics_.tool(); }
  const std::string& notice() const { return haptics_.notice(); }
  const Extremes& extremes() const { return extremes_; }  // so far

 private:
  void run_ticks();
  void publish_model();

  const Scene* scene_;
  simulation::Simulation* simulation_;
  SampleTable* samples_;
  RecordingWriter* recorder_;
  Conductor conductor_;
  device::SimulatedDevice device_;
  LockstepHaptics haptics_;
  Extremes extremes_;
  StepRecord input_;
  std::vector<TickRecord> ticks_;
};

}  // namespace myotact::scene
