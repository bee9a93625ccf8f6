#pragma once

#include <array>

#include "device/shared_motor.h"
#include "realtime/watchdog.h"
#include "scene/scene_file.h"

namespace myotact::app {

/// The motors of as many simulated devices as a person has hands.
class MotorGroup : public realtime::ForceCutout {
 public:
  device::SharedMotor& operator[](std::size_t tool) { return motors_[tool]; }
  void cut() noexcept override {
    for (device::SharedMotor& motor : motors_) motor.cut();
  }

 private:
  std::array<device::SharedMotor, scene::kMostTools> motors_;
};

/// The motors of the simulated devices and the process that sees to zero force on all of them when this one dies or
/// hangs. Made before any other thread.
struct GuardedMotors {
  MotorGroup motors;
  realtime::Watchdog watchdog{motors};
};

}  // namespace myotact::app
