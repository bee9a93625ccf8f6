#include "layer/force_layer.h"

#include <cmath>

#include <spdlog/spdlog.h>

#include "haptics/haptic_group.h"

namespace myotact::layer {

ForceLayer::ForceLayer(Engine& engine, std::span<const LayerTool> tools)
    : engine_(engine), step_ns_(static_cast<std::uint64_t>(std::llround(engine.step_s() * 1e9))), check_(engine) {
  for (const LayerTool& tool : tools) {
    loops_.push_back(std::make_unique<haptics::HapticLoop>(*tool.device, tool.settings));
    group_.push_back(loops_.back().get());
  }
}

void ForceLayer::prepare(std::uint64_t now_ns) {
  for (std::size_t i = 0; i < group_.size(); ++i) {
    group_[i]->prepare(now_ns);
    group_[i]->tool_states().update();
    engine_.move_tool(static_cast<int>(i), group_[i]->tool_states().front());
  }
  publish(now_ns);
}

void ForceLayer::advance() {
  for (std::size_t i = 0; i < group_.size(); ++i) {
    group_[i]->tool_states().update();
    engine_.move_tool(static_cast<int>(i), group_[i]->tool_states().front());
  }
  engine_.advance();
}

void ForceLayer::publish(std::uint64_t now_ns) {
  const std::uint64_t before_ns = published_at_ns_.load(std::memory_order_relaxed);
  if (before_ns != 0 && now_ns > before_ns + kSilent_ns) {
    check_.note_silence(1e-9 * static_cast<double>(now_ns - before_ns));
  }
  ++sequence_;
  for (std::size_t i = 0; i < group_.size(); ++i) {
    messages::LocalModel& model = group_[i]->models().back();
    model = messages::LocalModel{};
    engine_.write_surface(static_cast<int>(i), model);
    model.reported = {};
    engine_.report_contacts(static_cast<int>(i), model.reported);
    check_.clean(model.reported);
    check_.look_at(model);
    model.sequence = sequence_;
    model.published_at_ns = now_ns;
    model.dt_ns = step_ns_;
    model.tool_sequence = group_[i]->tool_states().front().sequence;
    group_[i]->models().publish();
  }
  published_at_ns_.store(now_ns, std::memory_order_relaxed);
  report_news();
}

void ForceLayer::report_news() {
  for (const std::string& line : check_.take_news()) spdlog::warn("{}", line);
}

void ForceLayer::step(std::uint64_t now_ns) {
  advance();
  publish(now_ns);
}

void ForceLayer::tick(std::uint64_t now_ns) noexcept {
  haptics::tick_all(group_, now_ns);
}

void ForceLayer::stop_forces(bool stopped) noexcept {
  haptics::stop_forces(group_, stopped);
}

std::optional<std::uint64_t> ForceLayer::silent_since_ns(std::uint64_t now_ns) const noexcept {
  const std::uint64_t published_ns = published_at_ns_.load(std::memory_order_relaxed);
  if (published_ns == 0 || now_ns < published_ns + kSilent_ns) return std::nullopt;
  return published_ns;
}

}  // namespace myotact::layer
