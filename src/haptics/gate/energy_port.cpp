#include "haptics/gate/energy_port.h"

#include <algorithm>
#include <cmath>

namespace myotact::haptics {

namespace {

constexpr double kSlow_s = 0.03;    // 5 Hz: above what limbs do of their own, below what a loop swings at
constexpr double kSwing_J = 2e-3;   // below what a store may hold (5-20 mJ); swings of 2 mW and less stay
constexpr double kRest_m_s = 1e-3;  // slower than this nothing useful can be damped

}  // namespace

Vec3 EnergyPort::admit(const PortTick& tick) noexcept {
  for (const double energy_J : {tick.credit_J, tick.allowance_J, tick.found_J}) energy_J_ += energy_J;
  const double forget = 1.0 - std::exp(-tick.dt_s / kSlow_s);
  slow_force_N_ += forget * (sent_N_ - slow_force_N_);
  slow_environment_m_s_ += forget * (tick.environment_moved_m / tick.dt_s - slow_environment_m_s_);
  const double slow_W = slow_force_N_.dot(slow_environment_m_s_);
  const double kept = std::exp(-tick.dt_s / settings_.leak_s);
  const double kept_swing = tick.opens ? 1.0 - forget : kept;  // what swings touches again at once
  swing_J_ = kept_swing * (swing_J_ + sent_N_.dot(tick.environment_moved_m) - tick.dt_s * slow_W);
  const double gave_J = sent_N_.dot(tick.hand_moved_m);
  const double stepped_J = std::clamp(gave_J - tick.spring_gave_J, 0.0, tick.friction_J);
  energy_J_ += sent_N_.dot(tick.environment_moved_m) - (gave_J - stepped_J);
  const double surplus_J = energy_J_ - tick.stored_J;
  if (surplus_J > 0.0) energy_J_ = tick.stored_J + kept * std::min(surplus_J, tick.opens ? 0.0 : settings_.store_J);
  if (!std::isfinite(energy_J_) || !std::isfinite(swing_J_)) reset();
  missing_J_ = std::max({0.0, -energy_J_, swing_J_ - kSwing_J - kSlow_s * std::abs(slow_W)});

  damping_Ns_m_ = 0.0;
  const Vec3 velocity_m_s = tick.hand_moved_m / tick.dt_s;
  const double moved_m = tick.hand_moved_m.norm();
  if (missing_J_ > 0.0 && moved_m >= kRest_m_s * tick.dt_s && moved_m > tick.unclear_m) {
    damping_Ns_m_ = std::min(missing_J_ / (tick.dt_s * velocity_m_s.squaredNorm()), tick.most_damping_Ns_m);
  }
  asked_N_ = tick.wanted_N - damping_Ns_m_ * velocity_m_s;
  sent_N_ = Vec3::Zero();  // until book()
  return asked_N_;
}

}  // namespace myotact::haptics
