#include "haptics/force_gate.h"

#include <algorithm>
#include <cmath>

#include "haptics/faults.h"

namespace myotact::haptics {

namespace {

constexpr std::uint64_t kFreshFor_ns = 30'000'000;    // FORMATS, force gate
constexpr std::uint64_t kZeroAfter_ns = 100'000'000;  // FORMATS, force gate
/// Added damping b is stable in a loop of period T on a mass m below about m / T; this keeps well away (reference 2.6).
constexpr double kDampingShare = 0.4;
/// A late tick may not let the force jump by more than five ordinary ones.
constexpr double kLongestTick_s = 5e-3;
constexpr double kRest_m_s = 1e-3;  // slower than this nothing useful can be damped

Vec3 clamp_norm(const Vec3& force_N, double limit_N) {
  const double norm_N = force_N.norm();
  return norm_N > limit_N ? Vec3(force_N * (limit_N / norm_N)) : force_N;
}

bool is_stale(const GateInput& input, std::uint64_t after_ns) {
  return !input.has_model ||
         (input.now_ns > input.model_arrived_ns && input.now_ns - input.model_arrived_ns > after_ns);
}

std::uint64_t fresh_for_ns(const GateInput& input) {
  return std::clamp<std::uint64_t>(input.step_ns > kZeroAfter_ns ? kZeroAfter_ns : 2 * input.step_ns, kFreshFor_ns,
                                   kZeroAfter_ns);
}

}  // namespace

ForceGate::ForceGate(const device::DeviceProfile& profile, const GateSettings& settings)
    : profile_(profile), settings_(settings) {}

Vec3 ForceGate::shut(GateState state) noexcept {
  state_ = state;
  gain_ = 0.0;
  energy_J_ = 0.0;
  has_last_ = false;
  last_sent_N_ = Vec3::Zero();
  return last_sent_N_;
}

Vec3 ForceGate::admit(const GateInput& input) noexcept {
  faults_ = 0;
  const double elapsed_s =
      has_last_ && input.now_ns > last_ns_ ? 1e-9 * static_cast<double>(input.now_ns - last_ns_) : 1e-3;
  const double dt_s = std::clamp(elapsed_s, 1e-5, kLongestTick_s);
  last_ns_ = input.now_ns;
  if (!enabled_.load(std::memory_order_acquire)) {
    if (state_ != GateState::Off) faults_ |= bit(Fault::Stopped);
    return shut(GateState::Off);
  }
  if (state_ == GateState::Off) state_ = GateState::Armed;
  if (!input.connected) faults_ |= bit(Fault::DeviceLost);
  if (!input.device_position_m.allFinite()) faults_ |= bit(Fault::NonFiniteDevice);
  if (faults_ != 0) return shut(GateState::Armed);
  if (!input.wanted_N.allFinite()) {
    faults_ |= bit(Fault::NonFiniteForce);
    return shut(state_ == GateState::Armed ? GateState::Armed : GateState::Ramp);
  }
  change_state(input, dt_s);
  const Vec3 moved_m = has_last_ ? Vec3(input.device_position_m - last_position_m_) : Vec3::Zero();
  last_position_m_ = input.device_position_m;
  has_last_ = true;
  const Vec3 clamped_N = clamp_norm(gain_ * input.wanted_N, profile_.peak_force_N);
  const Vec3 passive_N = keep_passive(limit_rise(clamped_N, dt_s), moved_m, dt_s);
  last_sent_N_ = passive_N.allFinite() ? clamp_norm(passive_N, profile_.peak_force_N) : Vec3::Zero();
  return last_sent_N_;
}

void ForceGate::change_state(const GateInput& input, double dt_s) noexcept {
  const std::uint64_t fresh_ns = fresh_for_ns(input);
  const bool stale = is_stale(input, fresh_ns);
  if (stale && input.has_model) faults_ |= bit(Fault::StaleModel);
  if (stale && (state_ == GateState::Ramp || state_ == GateState::On)) {
    fade_from_ = gain_;
    state_ = GateState::Fade;
  } else if (!stale && state_ == GateState::Fade) {
    state_ = GateState::Ramp;
  } else if (!stale && state_ == GateState::Armed && input.wanted_N.norm() < settings_.arm_below_N) {
    state_ = GateState::Ramp;
  }
  if (state_ == GateState::Ramp) {
    gain_ = std::min(1.0, gain_ + dt_s / settings_.ramp_s);
    if (gain_ >= 1.0) state_ = GateState::On;
  } else if (state_ == GateState::Fade) {
    const std::uint64_t age_ns = input.has_model ? input.now_ns - input.model_arrived_ns : kZeroAfter_ns;
    const double left = age_ns >= kZeroAfter_ns ? 0.0
                                                : static_cast<double>(kZeroAfter_ns - age_ns) /
                                                      static_cast<double>(kZeroAfter_ns - fresh_ns);
    gain_ = std::min(gain_, fade_from_ * left);
  }
}

Vec3 ForceGate::limit_rise(const Vec3& force_N, double dt_s) const noexcept {
  return clamp_norm(force_N, last_sent_N_.norm() + settings_.slew_N_s * dt_s);
}

/// Books the work of the force that was really sent, which is exact because it was held between the two positions
/// (Hannaford and Ryu 2002); while more came out than may, damping takes it back.
Vec3 ForceGate::keep_passive(const Vec3& force_N, const Vec3& moved_m, double dt_s) noexcept {
  energy_J_ += settings_.active_power_W * dt_s - last_sent_N_.dot(moved_m);
  energy_J_ = std::min(energy_J_, settings_.energy_store_J);
  const Vec3 velocity_m_s = moved_m / dt_s;
  if (energy_J_ >= 0.0 || velocity_m_s.norm() < kRest_m_s) return force_N;
  faults_ |= bit(Fault::EnergyInjected);
  const double damping_Ns_m =
      std::min(-energy_J_ / (dt_s * velocity_m_s.squaredNorm()), kDampingShare * profile_.inertia_kg / dt_s);
  return force_N - damping_Ns_m * velocity_m_s;
}

}  // namespace myotact::haptics
