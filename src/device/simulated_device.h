#pragma once

#include "core/vector.h"
#include "device/device.h"
#include "realtime/latest_value.h"

namespace myotact::device {

/// A hand on a stylus: a mass on a spring and a damper to where the person wants it, and the device's own inertia and
/// friction. Ranges from identified grips at 1 to 3 N and from desktop devices of the 3 N class.
struct HandAndDevice {
  double hand_mass_kg = 0.1;
  double hand_damping_Ns_m = 5.0;
  double hand_stiffness_N_m = 400.0;
  double device_mass_kg = 0.07;
  double device_damping_Ns_m = 0.05;
  double device_friction_N = 0.1;    // Coulomb
  double encoder_m = 20e-6;          // resolution of the position
};

/// Where the hand wants the stylus; the writer is whoever plays the person.
struct HandTarget {
  std::array<double, 3> position_world_m{};
  std::uint32_t buttons = 0;
};

/// Simulated person and device; stands for hardware in tests, headless runs and demonstrations.
class SimulatedDevice : public Device {
 public:
  explicit SimulatedDevice(const Vec3& start_world_m, const HandAndDevice& parameters = {});

  realtime::LatestValue<HandTarget>& target() noexcept { return target_; }

  const Profile& profile() const override { return profile_; }
  void open() override {}
  bool ready() const noexcept override { return true; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override;
  void write(const messages::DeviceCommand& command) noexcept override;

 private:
  void integrate(double dt_s) noexcept;

  Profile profile_{"simulated", 10.0, 0.3};
  HandAndDevice parameters_;
  realtime::LatestValue<HandTarget> target_;
  Vec3 wanted_m_;
  Vec3 position_m_;
  Vec3 velocity_m_s_ = Vec3::Zero();
  Vec3 force_N_ = Vec3::Zero();
  std::uint64_t last_ns_ = 0;
};

}  // namespace myotact::device
