#pragma once

#include <cstdint>
#include <span>

#include "layer/force_layer.h"

namespace myotact::layer {

/// A layer on one virtual clock, the same to the bit every time. Ticks are 1 ms; steps need not be whole ones: step n
/// is due n step_s after the start, is taken before the first tick that is not earlier than that, from the states of
/// the ticks before, and is published as of when it was due. At 60 Hz steps are so 16, 17 and 17 ticks apart and yet
/// play evenly; nothing drifts.
///
///   ticks   0 1 2 ... 16 | 17 ... 33 | 34 ... 49 | 50
///   steps              1^          2^          3^      due at 16.67, 33.33, 50 ms
class LockstepLayer {
 public:
  /// Opens the devices, publishes the first models. All arguments outlive this. Throws Error.
  LockstepLayer(Engine& engine, std::span<const LayerTool> tools);

  /// The steps that are due, then one tick of every tool.
  void tick();
  double time_s() const { return 1e-9 * static_cast<double>(ticks_ * haptics::kTickPeriod_ns); }  // of the next tick
  std::uint64_t step_count() const { return steps_; }
  ForceLayer& layer() { return layer_; }
  haptics::HapticLoop& loop(int tool) { return layer_.loop(tool); }

  /// False: the engine stands, as one that hangs; what it missed is skipped.
  void let_engine_run(bool runs) { runs_ = runs; }

 private:
  ForceLayer layer_;
  double step_s_;
  bool runs_ = true;
  std::uint64_t ticks_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace myotact::layer
