#include "device/simulated_device.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace myotact::device {

namespace {

/// Ten a tick: the fastest pole of the stiffest hand (500 N/m on 0.1 kg, 11 Hz) needs far less, friction does not.
constexpr double kSubStep_s = 1e-4;
/// A pause longer than this (a stopped process) moves the hand no farther, and a tick stays short.
constexpr double kLongestGap_s = 0.02;
/// A target that is not renewed stops: the hand holds still where it wanted to be.
constexpr double kTargetLife_s = 0.05;
/// One count of a 20 um encoder in 1 ms reads as 20 mm/s; this lag makes 3 mm/s of it, little against the damping.
constexpr double kVelocityFilter_s = 5e-3;
constexpr double kTremor_Hz = 9.0;  // physiological tremor of a hand that holds something: 8 .. 10 Hz

/// In three directions a third of a period apart.
Vec3 tremor_m(double amplitude_m, double time_s) {
  const double angle = 2.0 * std::numbers::pi * kTremor_Hz * time_s, third = 2.0 * std::numbers::pi / 3.0;
  return amplitude_m * Vec3(std::sin(angle), std::sin(angle + third), std::sin(angle + 2.0 * third));
}

Vec3 saturated(const Vec3& force_N, double peak_N) {
  const double norm_N = force_N.norm();
  return norm_N > peak_N ? Vec3(force_N * (peak_N / norm_N)) : force_N;
}

}  // namespace

SimulatedDevice::SimulatedDevice(std::string name, const Vec3& start_world_m, const DeviceProfile& profile,
                                 const HandProfile& hand)
    : name_(std::move(name)),
      profile_(profile),
      hand_(hand),
      position_m_(start_world_m),
      target_m_(start_world_m),
      measured_m_(start_world_m) {
  commands_N_.fill(Vec3::Zero());
}

void SimulatedDevice::write(const messages::DeviceCommand& command) noexcept {
  const auto delay =
      static_cast<std::size_t>(std::clamp(profile_.delay_ticks, 0, static_cast<int>(commands_N_.size()) - 1));
  commands_N_[written_ % commands_N_.size()] = saturated(to_vec3(command.force_world_N), profile_.peak_force_N);
  force_N_ = written_ < delay ? Vec3(Vec3::Zero()) : commands_N_[(written_ - delay) % commands_N_.size()];
  ++written_;
  if (motor_ != nullptr) motor_->set_force(force_N_);
}

messages::DeviceState SimulatedDevice::read(std::uint64_t now_ns) noexcept {
  if (targets_.update()) {
    target_m_ = to_vec3(targets_.front().position_world_m);
    target_velocity_m_s_ = to_vec3(targets_.front().velocity_world_m_s);
    buttons_ = targets_.front().buttons;
    push_N_ = to_vec3(targets_.front().push_world_N);
    target_age_s_ = 0.0;
  }
  if (motor_ != nullptr) force_N_ = motor_->force_world_N();
  const double dt_s = started_ && now_ns > last_ns_ ? 1e-9 * static_cast<double>(now_ns - last_ns_) : 0.0;
  started_ = true;
  last_ns_ = now_ns;
  advance(std::min(dt_s, kLongestGap_s));
  return measure(now_ns, dt_s);
}

void SimulatedDevice::advance(double dt_s) noexcept {
  const int steps = static_cast<int>(std::ceil(dt_s / kSubStep_s - 1e-6));
  for (int step = 0; step < steps; ++step) integrate(dt_s / steps);
}

// Implicit Euler in the linear part, then Coulomb friction in closed form: it takes away at most the velocity there is.
void SimulatedDevice::integrate(double h_s) noexcept {
  target_age_s_ += h_s;
  tremor_s_ += h_s;
  const bool runs_on = target_age_s_ <= kTargetLife_s;
  if (runs_on) target_m_ += h_s * target_velocity_m_s_;
  const Vec3 target_velocity_m_s = runs_on ? target_velocity_m_s_ : Vec3::Zero();
  const double mass_kg = profile_.inertia_kg + hand_.mass_kg;
  const double k = hand_.stiffness_N_m;
  const double b = hand_.damping_Ns_m;
  const Vec3 wanted_m = hand_.tremor_m > 0.0 ? Vec3(target_m_ + tremor_m(hand_.tremor_m, tremor_s_)) : target_m_;
  const Vec3 force_N = k * (wanted_m - position_m_) + b * target_velocity_m_s + push_N_ + force_N_;
  Vec3 v = (mass_kg * velocity_m_s_ + h_s * force_N) / (mass_kg + h_s * (b + profile_.viscous_Ns_m) + h_s * h_s * k);
  const double speed_m_s = v.norm();
  const double lost_m_s = h_s * profile_.coulomb_N / mass_kg;
  v *= speed_m_s > lost_m_s ? 1.0 - lost_m_s / speed_m_s : 0.0;
  velocity_m_s_ = v;
  position_m_ += h_s * v;
}

messages::DeviceState SimulatedDevice::measure(std::uint64_t now_ns, double dt_s) noexcept {
  const double resolution_m = profile_.resolution_m;
  const Vec3 rounded_m =
      resolution_m > 0.0 ? Vec3((position_m_ / resolution_m).array().round().matrix() * resolution_m) : position_m_;
  if (dt_s > 0.0) {
    const Vec3 difference_m_s = (rounded_m - measured_m_) / dt_s;
    measured_velocity_m_s_ += dt_s / (dt_s + kVelocityFilter_s) * (difference_m_s - measured_velocity_m_s_);
  }
  measured_m_ = rounded_m;
  return {to_array(measured_m_), to_array(measured_velocity_m_s_), now_ns, buttons_};
}

}  // namespace myotact::device
