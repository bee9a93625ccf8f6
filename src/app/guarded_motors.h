#pragma once

#include "device/shared_motor.h"
#include "realtime/watchdog.h"

namespace myotact::app {

/// The motors of the simulated devices and the process that sees to zero force on all of them when this one dies or
/// hangs. Made before any other thread.
struct GuardedMotors {
  device::MotorGroup motors;
  realtime::Watchdog watchdog{motors};
};

}  // namespace myotact::app
