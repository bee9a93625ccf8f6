#include "device/simulated_device.h"

#include <algorithm>
#include <cmath>

namespace myotact::device {

namespace {

constexpr int kSubsteps = 4;          // 0.25 ms at 1 kHz: a tenth of the fastest mode's period
constexpr double kLongestGap_s = 0.02;  // after a pause the hand does not jump

}  // namespace

SimulatedDevice::SimulatedDevice(const Vec3& start_world_m, const HandAndDevice& parameters)
    : parameters_(parameters), wanted_m_(start_world_m), position_m_(start_world_m) {}

/// Semi-implicit: damping and friction at the new velocity, so that neither can feed energy in.
void SimulatedDevice::integrate(double dt_s) noexcept {
  const double mass = parameters_.hand_mass_kg + parameters_.device_mass_kg;
  const double damping = parameters_.hand_damping_Ns_m + parameters_.device_damping_Ns_m;
  const Vec3 spring_N = parameters_.hand_stiffness_N_m * (wanted_m_ - position_m_);
  Vec3 v = (velocity_m_s_ + dt_s / mass * (spring_N + force_N_)) / (1.0 + dt_s * damping / mass);
  const double speed = v.norm();
  const double stopped_by = dt_s * parameters_.device_friction_N / mass;
  v = speed > stopped_by ? Vec3(v * (1.0 - stopped_by / speed)) : Vec3::Zero();
  velocity_m_s_ = v;
  position_m_ += dt_s * v;
}

messages::DeviceState SimulatedDevice::read(std::uint64_t now_ns) noexcept {
  if (target_.fetch()) wanted_m_ = to_vec3(target_.front().position_world_m);
  if (last_ns_ != 0 && now_ns > last_ns_) {
    const double gap_s = std::min(static_cast<double>(now_ns - last_ns_) * 1e-9, kLongestGap_s);
    for (int i = 0; i < kSubsteps; ++i) integrate(gap_s / kSubsteps);
  }
  last_ns_ = now_ns;
  messages::DeviceState state;
  const double count_m = parameters_.encoder_m;
  for (std::size_t k = 0; k < 3; ++k) {
    state.stylus_position_world_m[k] = std::round(position_m_[static_cast<Eigen::Index>(k)] / count_m) * count_m;
  }
  state.stylus_velocity_world_m_s = to_array(velocity_m_s_);
  state.sampled_at_ns = now_ns;
  state.buttons = target_.front().buttons;
  return state;
}

void SimulatedDevice::write(const messages::DeviceCommand& command) noexcept { force_N_ = to_vec3(command.force_world_N); }

}  // namespace myotact::device
