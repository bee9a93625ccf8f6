#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "device/simulated_device.h"
#include "messages/scene_frame.h"
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
  const messages::ToolState& tool(std::size_t index = 0) const { return haptics_.last_tick(index).tool; }
  std::vector<messages::ToolFrame> tool_frames() const;  // as they are drawn
  const std::string& notice() const { return haptics_.notice(); }
  const Extremes& extremes() const { return extremes_; }  // so far

 private:
  void run_ticks();
  void publish_models();

  const Scene* scene_;
  simulation::Simulation* simulation_;
  SampleTable* samples_;
  RecordingWriter* recorder_;
  Conductor conductor_;
  std::vector<std::unique_ptr<device::SimulatedDevice>> devices_;  // one a tool
  LockstepHaptics haptics_;
  Extremes extremes_;
  StepRecord input_;
  std::vector<std::vector<TickRecord>> ticks_;  // of the present step, tool by tool
};

}  // namespace myotact::scene
