#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "device/device.h"
#include "haptics/haptic_loop.h"
#include "layer/engine.h"
#include "layer/report_check.h"

namespace myotact::layer {

struct LayerTool {
  device::Device* device = nullptr;  // outlives the layer
  haptics::HapticSettings settings;
};

/// A 1 kHz hand for a slow engine, or two: between the engine and each tool stand two newest-wins channels (those of
/// the tool's HapticLoop), and nothing else. No lock, and no tool waits for another.
///
///   engine's thread        advance()  tool states --> Engine::move_tool, Engine::advance
///                          publish()  Engine::write_surface, report_contacts --> ReportCheck --> models
///   devices' thread        ticks of the loops: models --> force method, ports, gate --> devices; tool states
///
/// Who calls owns the clocks: LockstepLayer a virtual one, LayerThreads those of the wall.
class ForceLayer {
 public:
  /// `engine` outlives the layer. At least one tool; tool i of the engine is tools[i].
  ForceLayer(Engine& engine, std::span<const LayerTool> tools);

  /// Opens the devices and publishes the first models. Before the first tick, by the clock of the ticks. Throws Error
  /// Unavailable.
  void prepare(std::uint64_t now_ns);

  // ---- engine's thread; logs what is wrong with the reports, once a kind
  /// The newest states of all tools to the engine, and one step of it.
  void advance();
  /// What it looks like after the step, as of `now_ns`: the tools play it over the next step.
  void publish(std::uint64_t now_ns);
  /// Both; for lockstep.
  void step(std::uint64_t now_ns);

  // ---- the devices' thread
  /// One tick of every tool.
  void tick(std::uint64_t now_ns) noexcept;

  // ---- any thread
  /// The one emergency stop: force zero on every tool from its next tick on; false: armed again, through the ramp. A
  /// stop button on one device does the same.
  void stop_forces(bool stopped) noexcept;
  /// When the engine published last, if that is kSilent_ns and more ago: it hangs. By now the gates have faded.
  std::optional<std::uint64_t> silent_since_ns(std::uint64_t now_ns) const noexcept;
  const ReportCheck& check() const noexcept { return check_; }

  Engine& engine() noexcept { return engine_; }
  std::span<haptics::HapticLoop* const> loops() const noexcept { return group_; }
  haptics::HapticLoop& loop(int tool) noexcept { return *group_[static_cast<std::size_t>(tool)]; }

 private:
  void report_news();

  Engine& engine_;
  std::uint64_t step_ns_;
  std::vector<std::unique_ptr<haptics::HapticLoop>> loops_;
  std::vector<haptics::HapticLoop*> group_;  // the same
  ReportCheck check_;
  std::uint64_t sequence_ = 0;  // of the models
  std::atomic<std::uint64_t> published_at_ns_{0};
};

}  // namespace myotact::layer
