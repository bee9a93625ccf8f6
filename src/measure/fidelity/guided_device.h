#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "core/vector.h"
#include "device/device.h"

namespace myotact::measure {

/// A stylus that is where the goal puts it, read through an encoder and a filter as a real one.
class GuidedDevice : public device::Device {
 public:
  explicit GuidedDevice(double peak_N) {
    profile_.peak_force_N = peak_N;
    profile_.coulomb_N = 0.3;
  }
  const std::string& name() const override { return name_; }
  const device::DeviceProfile& profile() const override { return profile_; }
  void open() override {}
  void close() noexcept override {}
  bool connected() const noexcept override { return true; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override {
    constexpr double kFilter_s = 5e-3;  // as the simulated device has it
    const double resolution_m = profile_.resolution_m;
    const Vec3 seen_m = (position_m / resolution_m).array().round().matrix() * resolution_m;
    if (now_ns > last_ns_ && last_ns_ > 0) {
      const double dt_s = 1e-9 * static_cast<double>(now_ns - last_ns_);
      velocity_m_s_ += dt_s / (dt_s + kFilter_s) * ((seen_m - seen_m_) / dt_s - velocity_m_s_);
    }
    seen_m_ = seen_m;
    last_ns_ = now_ns;
    return {to_array(seen_m), to_array(velocity_m_s_), now_ns, buttons};
  }
  void write(const messages::DeviceCommand&) noexcept override {}

  Vec3 position_m = Vec3::Zero();
  std::uint32_t buttons = 0;

 private:
  std::string name_ = "guided";
  device::DeviceProfile profile_;
  Vec3 seen_m_ = Vec3::Zero(), velocity_m_s_ = Vec3::Zero();
  std::uint64_t last_ns_ = 0;
};

}  // namespace myotact::measure
