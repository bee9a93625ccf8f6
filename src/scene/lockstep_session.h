#pragma once

#include <cstdint>
#include <memory>

#include "device/simulated_device.h"
#include "haptics/haptic_loop.h"
#include "scene/conductor.h"
#include "scene/extremes.h"
#include "scene/recording.h"
#include "scene/samples.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// Settings of a scene's tool for its haptic loop.
haptics::HapticSettings haptic_settings(const ToolSettings& tool);

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
  const messages::ToolState& tool() const { return loop_.tool_state(); }
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
  haptics::HapticLoop loop_;
  std::uint64_t clock_ns_ = 0;
  std::uint64_t model_sequence_ = 0;
  Extremes extremes_;
  StepRecord input_;
  std::vector<TickRecord> ticks_;
};

}  // namespace myotact::scene
