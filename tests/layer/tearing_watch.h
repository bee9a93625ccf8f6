#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstring>

#include "device/device.h"
#include "haptics/haptic_loop.h"
#include "layer/engine.h"

namespace myotact::layer {

/// Stamps what an engine sends, and looks whether it arrives whole:
///
///   down: write_surface() stamps the model with a number and a sum over all that it holds; the devices' thread adds up
///         again what the loop uses, in the middle of its tick
///   up:   a tool's state comes by two channels, the newest-wins one and the loop's record of ticks; both must hold the
///         same bytes for the same sequence number
///
/// The stamp takes the place of the joint, which no tool reads.
class TearingWatch {
 public:
  static void stamp(messages::LocalModel& model, std::uint64_t number) {
    model.joint.angle_rad = static_cast<double>(number);
    model.joint.torque_Nm = std::bit_cast<double>(sum_of(model));
    model.joint.inertia_kg_m2 = 1.0;  // stamped
  }

  /// Devices' thread.
  void look_at(const messages::LocalModel& model) noexcept {
    if (model.joint.inertia_kg_m2 != 1.0) return;
    models_.fetch_add(1, std::memory_order_relaxed);
    if (sum_of(model) != std::bit_cast<std::uint64_t>(model.joint.torque_Nm)) {
      torn_.fetch_add(1, std::memory_order_relaxed);
    }
  }

  /// Engine's thread. The record may be a tick behind the newest state: then the next call finds it.
  void look_at(const messages::ToolState& state, haptics::HapticLoop& loop) {
    waiting_[waiting_count_++ % waiting_.size()] = state;
    for (haptics::HapticTick tick; loop.ticks().pop(tick);) {
      for (messages::ToolState& waiting : waiting_) {
        if (waiting.sequence == 0 || waiting.sequence != tick.tool.sequence) continue;
        states_.fetch_add(1, std::memory_order_relaxed);
        if (std::memcmp(&waiting, &tick.tool, sizeof waiting) != 0) torn_.fetch_add(1, std::memory_order_relaxed);
        waiting.sequence = 0;
      }
    }
  }

  std::uint64_t models() const noexcept { return models_.load(std::memory_order_relaxed); }  // looked at
  std::uint64_t states() const noexcept { return states_.load(std::memory_order_relaxed); }
  std::uint64_t torn() const noexcept { return torn_.load(std::memory_order_relaxed); }

 private:
  static void add(std::uint64_t& sum, const void* data, std::size_t bytes) noexcept {
    const auto* at = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i + sizeof sum <= bytes; i += sizeof sum) {
      std::uint64_t word = 0;
      std::memcpy(&word, at + i, sizeof word);
      sum = (sum ^ word) * 0x100000001b3u;  // FNV-1a by words
    }
  }
  static std::uint64_t sum_of(const messages::LocalModel& model) noexcept {
    std::uint64_t sum = 0xcbf29ce484222325u;
    add(sum, &model.joint.angle_rad, sizeof model.joint.angle_rad);
    add(sum, model.previous_world_m.data(), sizeof model.previous_world_m);
    add(sum, model.current_world_m.data(), sizeof model.current_world_m);
    add(sum, model.triangles.data(), sizeof model.triangles);
    add(sum, &model.grip, sizeof model.grip);
    return sum;
  }

  std::array<messages::ToolState, 4> waiting_{};
  std::size_t waiting_count_ = 0;
  std::atomic<std::uint64_t> models_{0}, states_{0}, torn_{0};
};

/// An engine whose models are stamped and whose tools' states are looked at. `loops` are set before it runs.
class WatchedEngine : public Engine {
 public:
  explicit WatchedEngine(Engine& inner) : inner_(inner) {}

  std::string_view name() const override { return inner_.name(); }
  double step_s() const override { return inner_.step_s(); }
  int surface_count() const override { return inner_.surface_count(); }
  void move_tool(int tool, const messages::ToolState& state) override {
    const auto i = static_cast<std::size_t>(tool);
    if (loops[i] != nullptr && state.sequence != 0) watches[i].look_at(state, *loops[i]);
    inner_.move_tool(tool, state);
  }
  void advance() override { inner_.advance(); }
  void report_contacts(int tool, messages::ReportedContacts& reported) const override {
    inner_.report_contacts(tool, reported);
  }
  Pose body_pose(int surface) const override { return inner_.body_pose(surface); }
  void write_surface(int tool, messages::LocalModel& model) const override {
    inner_.write_surface(tool, model);
    TearingWatch::stamp(model, ++stamps_);
  }

  std::array<haptics::HapticLoop*, 2> loops{};
  std::array<TearingWatch, 2> watches;

 private:
  Engine& inner_;
  mutable std::uint64_t stamps_ = 0;
};

/// A device between whose read() and write() lies a tick: at its end the model in use is looked at. Keeps the largest
/// step of the force that was sent while the gate was open.
class WatchedDevice : public device::Device {
 public:
  explicit WatchedDevice(device::Device& inner) : inner_(inner) {}
  void watch(haptics::HapticLoop& loop, TearingWatch& watch) {
    loop_ = &loop;
    watch_ = &watch;
  }

  const std::string& name() const override { return inner_.name(); }
  const device::DeviceProfile& profile() const override { return inner_.profile(); }
  void open() override { inner_.open(); }
  void close() noexcept override { inner_.close(); }
  bool connected() const noexcept override { return inner_.connected(); }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override { return inner_.read(now_ns); }
  void write(const messages::DeviceCommand& command) noexcept override {
    if (watch_ != nullptr) watch_->look_at(loop_->models().front());
    const Vec3 force_N = to_vec3(command.force_world_N);
    const double step_N = (force_N - last_N_).norm();
    if (loop_ != nullptr && loop_->gate_state() == haptics::GateState::On) {
      if (step_N > largest_step_N()) largest_step_N_.store(step_N, std::memory_order_relaxed);
      if (step_N > kLargeStep_N) large_steps_.fetch_add(1, std::memory_order_relaxed);
    }
    last_N_ = force_N;
    inner_.write(command);
  }

  // ---- any thread
  void begin_again() noexcept {
    largest_step_N_.store(0.0, std::memory_order_relaxed);
    large_steps_.store(0, std::memory_order_relaxed);
  }
  double largest_step_N() const noexcept { return largest_step_N_.load(std::memory_order_relaxed); }
  std::uint64_t large_steps() const noexcept { return large_steps_.load(std::memory_order_relaxed); }  // over 30 mN

 private:
  static constexpr double kLargeStep_N = 0.030;  // the goal of a step of the force in one tick
  device::Device& inner_;
  haptics::HapticLoop* loop_ = nullptr;
  TearingWatch* watch_ = nullptr;
  Vec3 last_N_ = Vec3::Zero();
  std::atomic<double> largest_step_N_{0.0};
  std::atomic<std::uint64_t> large_steps_{0};
};

}  // namespace myotact::layer
