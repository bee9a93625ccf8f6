#pragma once

#include <atomic>
#include <cstdint>

#include "core/vector.h"
#include "device/device.h"
#include "haptics/gate/motor_heat.h"

namespace myotact::haptics {

struct GateSettings {
  double force_limit = 0.5;     // share of the device's peak force that is ever sent, 0 .. 1
  double ramp_s = 1.0;          // from nothing to the full force (own choice)
  double arm_below_N = 0.2;     // an armed gate opens only while less than this is wanted
  double slew_N_s = 300.0;      // of rising |F|
  double cut_off_m_s = 1.0;     // a device that moves faster gets no force (own choice)
  double energy_store_J = 0.1;  // of what the hand put in and may get back: 3.3 N drawn 30 mm
  double change_s = 0.1;        // from the full force to none, for another tool (own choice: as with an old model)
  double active_power_W = 0.1;  // muscles do real work on the hand; this much a second is no instability
};

enum class GateState { Off, Armed, Ramp, On, Fade };

struct GateInput {
  Vec3 wanted_N = Vec3::Zero();
  Vec3 device_position_m = Vec3::Zero();
  bool connected = true;
  bool cut = false;           // a watchdog took the force away
  bool changing = false;      // the hand is to get another tool, which it may not feel at once
  bool clutched = false;      // the hand moves without the tool, whose force must not drive it
  double damping_Ns_m = 0.0;  // already in the wanted force; device supports only so much
  bool has_model = false;
  std::uint64_t now_ns = 0;
  std::uint64_t model_arrived_ns = 0;  // when the newest model came in
  std::uint64_t step_ns = 0;           // of the simulation
};

/// The only way from a wanted force to a device.
///
///   enable()        |F| < 0.2 N            full
///   OFF ---> ARMED -------------> RAMP ----------> ON
///    ^ stop()  ^ lost, clutched    ^                | no new model for max(30 ms, 2 steps); zero at 100 ms
///              |                   '---- FADE <-----'  or while the tool is to change
///
/// A tick: finite check, ramp and fade, clamp, slew limit on rising |F|, passivity on the force really sent, clamp.
/// Faults of device, numbers and stop give zero in the same tick: a device that moves faster than any hand (20 m/s) is
/// at fault, one beyond the cut-off speed comes back through RAMP. A stop stays until enable(). The clock may stand,
/// jump or run backwards: then a tick counts as 1 ms. Real-time safe.
class ForceGate {
 public:
  ForceGate(const device::DeviceProfile& profile, const GateSettings& settings);

  void enable() noexcept { enabled_.store(true, std::memory_order_release); }  // any thread
  void stop() noexcept { enabled_.store(false, std::memory_order_release); }   // any thread; zero from the next tick on

  bool is_stopped() const noexcept { return !enabled_.load(std::memory_order_acquire); }  // any thread

  /// The force on the hand for this tick [N], |F| <= limit_N() before and after. Haptic thread.
  Vec3 admit(const GateInput& input) noexcept;

  /// What may be sent now [N]: the allowed share of the device's peak, less while its motors are warm.
  double limit_N() const noexcept { return heat_.limit_N(); }

  GateState state() const noexcept { return state_; }
  /// Nothing of what is wanted gets through, whatever it is. Haptic thread.
  bool is_shut() const noexcept { return gain_ <= 0.0; }
  /// Of the last admit, what the passivity of the sent force added [N].
  const Vec3& damping_N() const noexcept { return damping_N_; }
  std::uint32_t faults() const noexcept { return faults_; }  // bits of Fault raised by the last admit

 private:
  double advance_clock(const GateInput& input) noexcept;
  Vec3 watch_device(const GateInput& input, double elapsed_s) noexcept;
  Vec3 shut(GateState state) noexcept;
  void change_state(const GateInput& input, double dt_s) noexcept;
  Vec3 limit_rise(const Vec3& force_N, double dt_s) const noexcept;
  Vec3 keep_passive(const Vec3& force_N, const Vec3& moved_m, double damped_Ns_m, double dt_s) noexcept;

  device::DeviceProfile profile_;
  GateSettings settings_;
  std::atomic<bool> enabled_{false};
  GateState state_ = GateState::Off;
  double gain_ = 0.0;
  double fade_from_ = 0.0;
  double energy_J_ = 0.0;
  MotorHeat heat_;
  Vec3 last_sent_N_ = Vec3::Zero();
  Vec3 damping_N_ = Vec3::Zero();
  Vec3 last_position_m_ = Vec3::Zero();
  bool knows_position_ = false;
  std::uint64_t last_ns_ = 0;
  bool ticked_ = false;
  std::uint64_t model_arrived_ns_ = 0;
  std::uint64_t model_age_ns_ = 0;  // counted here: the caller's clock may run backwards
  std::uint32_t faults_ = 0;
};

}  // namespace myotact::haptics
