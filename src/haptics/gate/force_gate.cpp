#include "haptics/gate/force_gate.h"

#include <algorithm>
#include <cmath>

#include "haptics/faults.h"

namespace myotact::haptics {

namespace {

constexpr std::uint64_t kFreshFor_ns = 30'000'000;    // own choice
constexpr std::uint64_t kZeroAfter_ns = 100'000'000;  // own choice
/// Added damping b, held over a tick T, takes b T / m of the speed of a mass m: beyond 1 it reverses the motion.
/// This stays well below.
constexpr double kDampingShare = 0.4;
/// A late tick may not let the force jump by more than five ordinary ones.
constexpr double kLongestTick_s = 5e-3;
constexpr std::uint64_t kTick_ns = 1'000'000;  // what a tick counts whose clock stood still or ran backwards
/// Two reads closer together than this give no speed: a count of the encoder would read as 0.5 m/s.
constexpr double kShortestTick_s = 1e-4;
constexpr double kLongestHeat_s = 1.0;  // a held force after that long is no force of this loop any more
/// Faster than a thrown ball leaves the hand of an untrained person; 20 mm a tick.
constexpr double kFasterThanAnyHand_m_s = 20.0;
constexpr std::uint32_t kDeviceFaults =
    bit(Fault::DeviceLost) | bit(Fault::NonFiniteDevice) | bit(Fault::DeviceJumped) | bit(Fault::WatchdogCut);
constexpr double kRest_m_s = 1e-3;  // slower than this nothing useful can be damped

Vec3 clamp_norm(const Vec3& force_N, double limit_N) {
  const double norm_N = force_N.norm();
  return norm_N > limit_N ? Vec3(force_N * (limit_N / norm_N)) : force_N;
}

std::uint64_t fresh_for_ns(const GateInput& input) {
  return std::clamp<std::uint64_t>(input.step_ns > kZeroAfter_ns ? kZeroAfter_ns : 2 * input.step_ns, kFreshFor_ns,
                                   kZeroAfter_ns);
}

/// Bounds of the hand's own speed and energy as positions report them.
GateSettings scaled_to_positions(GateSettings settings, double motion_scale) {
  settings.cut_off_m_s *= motion_scale;
  settings.energy_store_J *= motion_scale;
  settings.active_power_W *= motion_scale;
  return settings;
}

}  // namespace

ForceGate::ForceGate(const device::DeviceProfile& profile, const GateSettings& settings)
    : profile_(profile),
      settings_(scaled_to_positions(settings, profile.motion_scale)),
      heat_(profile.continuous_force_N, std::clamp(settings.force_limit, 0.0, 1.0) * profile.peak_force_N) {}

Vec3 ForceGate::shut(GateState state) noexcept {
  state_ = state;
  gain_ = 0.0;
  energy_J_ = 0.0;
  last_sent_N_ = Vec3::Zero();
  return last_sent_N_;
}

/// Seconds since the last tick, > 0; keeps the age of the model.
double ForceGate::advance_clock(const GateInput& input) noexcept {
  std::uint64_t elapsed_ns = kTick_ns;
  if (ticked_ && input.now_ns > last_ns_) elapsed_ns = input.now_ns - last_ns_;
  if (ticked_ && input.now_ns < last_ns_) faults_ |= bit(Fault::ClockBackwards);
  const bool is_new = !ticked_ || input.model_arrived_ns != model_arrived_ns_;
  if (is_new)
    model_age_ns_ = input.now_ns > input.model_arrived_ns ? input.now_ns - input.model_arrived_ns : 0;
  else
    model_age_ns_ += std::min(elapsed_ns, kZeroAfter_ns);
  model_age_ns_ = std::min(model_age_ns_, 2 * kZeroAfter_ns);
  model_arrived_ns_ = input.model_arrived_ns;
  last_ns_ = input.now_ns;
  ticked_ = true;
  return 1e-9 * static_cast<double>(elapsed_ns);
}

/// How far the device moved; raises what is wrong with it.
Vec3 ForceGate::watch_device(const GateInput& input, double elapsed_s) noexcept {
  if (!input.connected) faults_ |= bit(Fault::DeviceLost);
  if (input.cut) faults_ |= bit(Fault::WatchdogCut);
  if (!input.device_position_m.allFinite()) faults_ |= bit(Fault::NonFiniteDevice);
  const bool known = knows_position_;
  knows_position_ = (faults_ & kDeviceFaults) == 0;
  if (!knows_position_) return Vec3::Zero();
  const Vec3 moved_m = known ? Vec3(input.device_position_m - last_position_m_) : Vec3::Zero();
  last_position_m_ = input.device_position_m;
  if (profile_.shows_force_only) return moved_m;
  const double speed_m_s = moved_m.norm() / std::max(elapsed_s, kShortestTick_s);
  if (!(speed_m_s <= profile_.motion_scale * kFasterThanAnyHand_m_s)) {
    faults_ |= bit(Fault::DeviceJumped);
  } else if (speed_m_s > settings_.cut_off_m_s) {
    faults_ |= bit(Fault::TooFast);
  }
  return moved_m;
}

Vec3 ForceGate::admit(const GateInput& input) noexcept {
  faults_ = 0;
  damping_N_ = Vec3::Zero();
  const double elapsed_s = advance_clock(input);
  heat_.book(last_sent_N_.norm(), std::min(elapsed_s, kLongestHeat_s));
  const Vec3 moved_m = watch_device(input, elapsed_s);
  if (!enabled_.load(std::memory_order_acquire)) {
    faults_ |= bit(Fault::Stopped);
    return shut(GateState::Off);
  }
  if (state_ == GateState::Off) state_ = GateState::Armed;
  if (input.clutched || (faults_ & kDeviceFaults) != 0) return shut(GateState::Armed);
  if (!input.wanted_N.allFinite()) faults_ |= bit(Fault::NonFiniteForce);
  if ((faults_ & (bit(Fault::NonFiniteForce) | bit(Fault::TooFast))) != 0) {
    return shut(state_ == GateState::Armed ? GateState::Armed : GateState::Ramp);
  }
  const double dt_s = std::clamp(elapsed_s, 1e-5, kLongestTick_s);
  change_state(input, dt_s);
  const Vec3 ramped_N = gain_ * input.wanted_N;
  const Vec3 clamped_N = clamp_norm(ramped_N, limit_N());
  if (ramped_N.norm() > limit_N() && heat_.cuts()) faults_ |= bit(Fault::MotorHot);
  const Vec3 passive_N = keep_passive(limit_rise(clamped_N, dt_s), moved_m, input.damping_Ns_m, dt_s);
  last_sent_N_ = passive_N.allFinite() ? clamp_norm(passive_N, limit_N()) : Vec3::Zero();
  return last_sent_N_;
}

void ForceGate::change_state(const GateInput& input, double dt_s) noexcept {
  const std::uint64_t fresh_ns = fresh_for_ns(input);
  const bool stale = !input.has_model || model_age_ns_ > fresh_ns;
  if (stale && input.has_model) faults_ |= bit(Fault::StaleModel);
  const bool fades = stale || input.changing;
  if (fades && (state_ == GateState::Ramp || state_ == GateState::On)) {
    fade_from_ = gain_;
    state_ = GateState::Fade;
  } else if (!fades && state_ == GateState::Fade) {
    state_ = GateState::Ramp;
  } else if (!fades && state_ == GateState::Armed && input.wanted_N.norm() < settings_.arm_below_N) {
    state_ = GateState::Ramp;
  }
  if (state_ == GateState::Ramp) {
    gain_ = std::min(1.0, gain_ + dt_s / settings_.ramp_s);
    if (gain_ >= 1.0) state_ = GateState::On;
  } else if (state_ == GateState::Fade) {
    const std::uint64_t age_ns = input.has_model ? model_age_ns_ : kZeroAfter_ns;
    const double left = age_ns >= kZeroAfter_ns ? 0.0
                                                : static_cast<double>(kZeroAfter_ns - age_ns) /
                                                      static_cast<double>(kZeroAfter_ns - fresh_ns);
    if (stale) gain_ = std::min(gain_, fade_from_ * left);
    if (input.changing) gain_ = std::max(0.0, gain_ - dt_s / settings_.change_s);
  }
}

Vec3 ForceGate::limit_rise(const Vec3& force_N, double dt_s) const noexcept {
  return clamp_norm(force_N, last_sent_N_.norm() + settings_.slew_N_s * dt_s);
}

/// Books the work of the force that was really sent, which is exact because it was held between the two positions
/// (Hannaford and Ryu 2002); while more came out than may, damping takes it back.
Vec3 ForceGate::keep_passive(const Vec3& force_N, const Vec3& moved_m, double damped_Ns_m, double dt_s) noexcept {
  energy_J_ += settings_.active_power_W * dt_s - last_sent_N_.dot(moved_m);
  energy_J_ = std::min(energy_J_, settings_.energy_store_J);
  const Vec3 velocity_m_s = moved_m / dt_s;
  if (energy_J_ >= 0.0 || velocity_m_s.norm() < kRest_m_s) return force_N;
  faults_ |= bit(Fault::EnergyInjected);
  const double bears_Ns_m = kDampingShare / (1 + std::max(0, profile_.delay_ticks)) * profile_.inertia_kg / dt_s;
  const double damping_Ns_m =
      std::clamp(-energy_J_ / (dt_s * velocity_m_s.squaredNorm()), 0.0, std::max(0.0, bears_Ns_m - damped_Ns_m));
  damping_N_ = -damping_Ns_m * velocity_m_s;
  return force_N + damping_N_;
}

}  // namespace myotact::haptics
