#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "device/replay_device.h"
#include "haptics/haptic_loop.h"
#include "scene/recording.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// What feeling a recording again came to so far.
struct ForceComparison {
  std::size_t compared = 0;           // tool states: those that a step consumed
  double largest_difference_N = 0.0;  // component by which a force differed; infinite when one was not a number
  double largest_force_N = 0.0;       // that was felt
};

/// One tool of a recording: its device states through a new haptic loop.
class ToolReplay {
 public:
  /// `tool`: of the scene, with at least one entry in `recording.tools`. All references outlive this.
  ToolReplay(const Scene& scene, const Recording& recording, const device::DeviceProfile& device, std::size_t tool);

  void feel(const simulation::Simulation& simulation);
  /// The ticks of the last feel(), to be taken out before the next one.
  realtime::BoundedFifo<haptics::HapticTick>& ticks() noexcept { return loop_.ticks(); }
  const ForceComparison& comparison() const { return comparison_; }
  const messages::FeltTool& felt_tool() const noexcept { return loop_.felt_tool(); }

 private:
  void publish(const ModelRecord& record, const simulation::Simulation& simulation);
  void tick(const TickRecord& record);

  const Recording& recording_;
  std::size_t tool_;
  std::uint64_t step_ns_;
  const ToolSettings& settings_;  // of the scene's tool
  device::ReplayDevice device_;
  haptics::HapticLoop loop_;
  std::size_t steps_felt_ = 0;  // calls of feel()
  std::size_t next_model_ = 0, next_tick_ = 0, next_step_ = 0;
  ForceComparison comparison_;
};

/// Feels a recording again, every tool of it, against the simulation that is run again beside it. Every tick gets the
/// model, the time and the stop that it had, so that in the same build and machine the forces come out bit for bit,
/// whether the recording was made in lockstep or on the wall clock.
///
///   models of step 0, ticks | step 1 (the caller's) | models of step 1, ticks | step 2 | ...
///         '------ feel() ---'                       '------- feel() --------'
class ForceReplay {
 public:
  /// `devices` are what was recorded with, one a tool; a tool without one had a simulated one. The recording fits the
  /// scene (require_fit). All references outlive this.
  ForceReplay(const Scene& scene, const Recording& recording, const std::vector<device::DeviceProfile>& devices);

  /// The ticks that used the models of this state; `simulation` stands after as many steps as were recorded up to
  /// there.
  void feel(const simulation::Simulation& simulation);

  /// Over all tools: counts added up, the largest of the others.
  ForceComparison comparison() const;
  std::size_t tool_count() const { return tools_.size(); }
  const ForceComparison& comparison(std::size_t tool) const { return tools_[tool]->comparison(); }
  /// What one tool felt in its last tick.
  const messages::FeltTool& felt_tool(std::size_t tool) const noexcept { return tools_[tool]->felt_tool(); }
  /// The ticks of one tool in the last feel(), to be taken out before the next one.
  realtime::BoundedFifo<haptics::HapticTick>& ticks(std::size_t tool) noexcept { return tools_[tool]->ticks(); }

 private:
  std::vector<std::unique_ptr<ToolReplay>> tools_;  // those that the recording holds anything of
};

}  // namespace myotact::scene
