#pragma once

#include "device/shared_motor.h"
#include "realtime/watchdog.h"

namespace myotact::app {

/// The motors of a simulated device and the process that sees to zero force when this one dies or hangs. Made before
/// any other thread.
struct GuardedMotor {
  device::SharedMotor motor;
  realtime::Watchdog watchdog{motor};
};

}  // namespace myotact::app
