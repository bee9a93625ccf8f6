#include "layer/lockstep_layer.h"

#include <cmath>

namespace myotact::layer {

namespace {

constexpr std::uint64_t kStart_ns = haptics::kTickPeriod_ns;  // time 0 means "never" to a device

}  // namespace

LockstepLayer::LockstepLayer(Engine& engine, std::span<const LayerTool> tools)
    : layer_(engine, tools), step_s_(engine.step_s()) {
  layer_.prepare(kStart_ns);
}

void LockstepLayer::tick() {
  const std::uint64_t elapsed_ns = ticks_ * haptics::kTickPeriod_ns;
  for (;; ++steps_) {
    const auto due_ns = static_cast<std::uint64_t>(std::llround(static_cast<double>(steps_ + 1) * step_s_ * 1e9));
    if (due_ns > elapsed_ns) break;
    if (runs_) layer_.step(kStart_ns + due_ns);
  }
  layer_.tick(kStart_ns + elapsed_ns);
  ++ticks_;
}

}  // namespace myotact::layer
