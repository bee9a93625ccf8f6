#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "app/line_input.h"
#include "core/vector.h"
#include "device/hardware_device.h"
#include "haptics/haptic_loop.h"
#include "haptics/haptic_thread.h"

namespace myotact::app {

/// One device with its loop and its thread, without a scene: what it is checked and calibrated on. Every force goes
/// through the gate.
class DeviceBench {
 public:
  /// Opens the device. `on_table`: the same one where it is real, else null. `watchdog`: of its motors, or null. All
  /// outlive this. `most_N`: that it ever pulls with; half of what the device supports is never exceeded. Throws Error
  /// Unavailable.
  DeviceBench(device::Device& device, device::HardwareDevice* on_table, realtime::Watchdog* watchdog, double most_N);

  /// Shows the person what the device needs until it is ready. False: interrupted first (interruption()).
  bool wait_until_ready(std::ostream& out);
  /// For that long: pulls as set, and measures.
  void run(std::chrono::milliseconds duration);
  /// The line that the person enters; nothing: a signal came, or the input has ended.
  std::optional<std::string> wait_for_line(LineInput& answers);

  /// From now on: with a spring to that point, or with that force wherever the hand goes.
  void pull_to(const Vec3& anchor_m);
  void pull_with(const Vec3& force_N);
  void let_go() { pulls_ = Pull::No; }
  /// Forces that a button of the device stopped are enabled again: after the person said yes to one.
  void enable_again() { loop_.stop_forces(false); }
  bool is_stopped() const { return loop_.is_stopped(); }

  Vec3 position_m() const { return position_m_; }
  double largest_N() const { return largest_N_; }
  void forget_force() { largest_N_ = 0.0; }
  std::uint32_t faults() const { return faults_; }
  /// Reach and buttons, and rate, in words.
  std::string range() const;
  std::string rate() const;

  /// The most that it pulls with [N], wherever the hand goes.
  double most_N() const { return most_N_; }

  static constexpr double kPull_N_m = 50.0;  // of the spring: soft enough for every device

 private:
  enum class Pull { No, ToPoint, WithForce };

  void publish();
  void look();

  const device::HardwareDevice* on_table_;
  const double most_N_;
  haptics::HapticLoop loop_;
  haptics::HapticThread thread_;
  std::uint64_t sequence_ = 0;
  Pull pulls_ = Pull::No;
  bool seen_ = false;
  Vec3 anchor_m_ = Vec3::Zero();    // a point, or its way from the stylus
  Vec3 position_m_ = Vec3::Zero();  // of the stylus
  Vec3 lowest_m_ = Vec3::Zero(), highest_m_ = Vec3::Zero();
  std::uint32_t buttons_ = 0, faults_ = 0;
  double largest_N_ = 0.0;
};

inline constexpr const char* kDeviceAxes[] = {"right", "up", "towards you"};

}  // namespace myotact::app
