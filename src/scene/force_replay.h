#pragma once

#include <cstddef>

#include "device/replay_device.h"
#include "scene/lockstep_haptics.h"
#include "scene/recording.h"

namespace myotact::scene {

/// Feels a lockstep recording again: its device states through a new haptic loop, against the simulation that is run
/// again beside it. Same build and machine: what the loop tells is bit for bit what was recorded.
///
///   per recorded step:   run_ticks() --> tool() against StepRecord::tool --> step (the caller's) --> publish_model()
class ForceReplay {
 public:
  /// `simulation` stands where the recording began. All references outlive this.
  ForceReplay(const Scene& scene, const Recording& recording, const simulation::Simulation& simulation);

  void run_ticks();
  void publish_model() { haptics_.publish_model(simulation_); }
  const messages::ToolState& tool() const { return haptics_.tool(); }

 private:
  const simulation::Simulation& simulation_;
  device::ReplayDevice device_;
  LockstepHaptics haptics_;
};

/// Largest component by which the forces on the hand differ [N]; infinite when one of them is not a number.
double force_difference_N(const messages::ToolState& a, const messages::ToolState& b);

}  // namespace myotact::scene
