#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/vector.h"
#include "device/device.h"
#include "device/shared_motor.h"
#include "realtime/latest_value.h"

namespace myotact::device {

/// A relaxed hand that holds a stylus and pulls it towards where it wants to be
/// (within 0.05-0.3 kg, 1-10 N s/m, 50-500 N/m: general knowledge).
struct HandProfile {
  double mass_kg = 0.1;
  double damping_Ns_m = 4.0;     // between the stylus and the hand's target
  double stiffness_N_m = 300.0;  // between the stylus and the hand's target
  double tremor_m = 0.0;         // amplitude with which the target trembles at 9 Hz; a person's: about 0.2 mm
};

/// Where the hand wants the stylus.
struct HandTarget {
  std::array<double, 3> position_world_m{};
  std::array<double, 3> velocity_world_m_s{};  // the target runs on with it; the next target comes within 50 ms
  std::uint32_t buttons = 0;
  std::array<double, 3> push_world_N{};  // on top of the springs: a weight, a finger on a stylus that is not held
};

/// A hand on a device, without hardware:
///
///   (m_device + m_hand) a = k_hand (target - x) + b_hand (v_target - v) - b_device v - Coulomb + F_command
///
/// integrated from one read to the next; the encoder rounds what is read, a command acts `delay_ticks` (at most 7)
/// later and with no more than the peak force. Same calls, same bits.
class SimulatedDevice : public Device {
 public:
  SimulatedDevice(std::string name, const Vec3& start_world_m, const DeviceProfile& profile = {},
                  const HandProfile& hand = {});

  /// From now on the motors are `motor`, which outlives the device and from which other processes may take the force.
  void drive(SharedMotor& motor) noexcept { motor_ = &motor; }

  /// One thread, any time, or between ticks. Real-time safe.
  void set_hand_target(const HandTarget& target) noexcept { targets_.publish(target); }

  const std::string& name() const override { return name_; }
  const DeviceProfile& profile() const override { return profile_; }
  void open() override {}
  void close() noexcept override {}
  bool connected() const noexcept override { return true; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override;
  void write(const messages::DeviceCommand& command) noexcept override;

  /// What the motors pull with now [N].
  Vec3 motor_force_N() const { return motor_ != nullptr ? motor_->force_world_N() : force_N_; }
  /// Truth that the encoder hides, for tests; the thread of read().
  const Vec3& position_world_m() const { return position_m_; }

 private:
  void advance(double dt_s) noexcept;
  void integrate(double h_s) noexcept;
  messages::DeviceState measure(std::uint64_t now_ns, double dt_s) noexcept;

  std::string name_;
  DeviceProfile profile_;
  HandProfile hand_;
  realtime::LatestValue<HandTarget> targets_;

  Vec3 position_m_;
  Vec3 velocity_m_s_ = Vec3::Zero();
  Vec3 target_m_;
  Vec3 target_velocity_m_s_ = Vec3::Zero();
  double target_age_s_ = 0.0;
  double tremor_s_ = 0.0;  // since the first read
  Vec3 push_N_ = Vec3::Zero();
  SharedMotor* motor_ = nullptr;
  Vec3 force_N_ = Vec3::Zero();     // of the motors
  std::array<Vec3, 8> commands_N_;  // on their way to the motors
  std::size_t written_ = 0;
  Vec3 measured_m_;
  Vec3 measured_velocity_m_s_ = Vec3::Zero();
  std::uint32_t buttons_ = 0;
  std::uint64_t last_ns_ = 0;
  bool started_ = false;
};

}  // namespace myotact::device
