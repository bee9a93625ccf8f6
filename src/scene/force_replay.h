#pragma once

#include <cstddef>
#include <cstdint>

#include "device/replay_device.h"
#include "haptics/haptic_loop.h"
#include "scene/recording.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// Feels a recording again: its device states through a new haptic loop, against the simulation that is run again
/// beside it. Every tick gets the model, the time and the stop that it had, so that in the same build and machine
/// the forces come out bit for bit, whether the recording was made in lockstep or on the wall clock.
///
///   models of step 0, ticks | step 1 (the caller's) | models of step 1, ticks | step 2 | ...
///         '------ feel() ---'                       '------- feel() --------'
class ForceReplay {
 public:
  /// `device` is what was recorded with. All references outlive this.
  ForceReplay(const Scene& scene, const Recording& recording, const device::DeviceProfile& device);

  /// The ticks that used the models of this state; `simulation` stands after as many steps as were recorded up to
  /// there.
  void feel(const simulation::Simulation& simulation);

  /// The ticks of the last feel(), to be taken out before the next one.
  realtime::BoundedFifo<haptics::HapticTick>& ticks() noexcept { return loop_.ticks(); }

  /// Tool states compared so far: those that a step consumed.
  std::size_t compared() const { return compared_; }
  /// Largest component by which a force differed [N]; infinite when one was not a number.
  double largest_difference_N() const { return largest_difference_N_; }
  double largest_force_N() const { return largest_force_N_; }

 private:
  void publish(const ModelRecord& record, const simulation::Simulation& simulation);
  void tick(const TickRecord& record);

  const Recording& recording_;
  std::uint64_t step_ns_;
  device::ReplayDevice device_;
  haptics::HapticLoop loop_;
  std::size_t steps_felt_ = 0;  // calls of feel()
  std::size_t next_model_ = 0, next_tick_ = 0, next_step_ = 0;
  std::size_t compared_ = 0;
  double largest_difference_N_ = 0.0, largest_force_N_ = 0.0;
};

}  // namespace myotact::scene
