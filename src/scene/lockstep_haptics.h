#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "device/device.h"
#include "haptics/haptic_loop.h"
#include "scene/recording.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// Settings of a scene's tool for its haptic loop.
haptics::HapticSettings haptic_settings(const ToolSettings& tool);

/// The settings that a scene's tools have and their devices do not support, one line a tool; or nothing.
std::string stiffness_notices(std::span<haptics::HapticLoop* const> loops, const Scene& scene);

/// The haptic loops of a scene's tools on the virtual clock:
///
///   ticks of a step --> step (the caller's) --> publish_model of each tool --> ticks ...
class LockstepHaptics {
 public:
  /// `devices`, one a tool, outlive this. Opens them. The first models are to be published before the first tick.
  LockstepHaptics(std::span<device::Device* const> devices, const Scene& scene);

  int ticks_a_step() const;
  double time_s() const;  // of the next tick
  void tick();
  /// The state after a step as a tool is shown it, felt from the next tick on.
  ModelRecord publish_model(std::size_t tool, const simulation::Simulation& simulation);

  std::size_t tool_count() const { return loops_.size(); }
  const messages::FeltTool& felt_tool(std::size_t tool) const { return loops_[tool]->felt_tool(); }
  const haptics::HapticTick& last_tick(std::size_t tool) const { return loops_[tool]->last_tick(); }
  const std::string& notice() const { return notice_; }  // what the devices do not support of the settings

 private:
  std::uint64_t step_ns_;
  std::vector<std::unique_ptr<haptics::HapticLoop>> owned_;
  std::vector<haptics::HapticLoop*> loops_;  // the same
  std::string notice_;
  std::uint64_t clock_ns_ = haptics::kTickPeriod_ns;  // time 0 means "never" to a device
  std::vector<std::uint64_t> model_sequences_;        // one a tool
  std::vector<double> report_radii_m_;                // likewise (model_writer.h)
};

}  // namespace myotact::scene
