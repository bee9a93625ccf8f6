#pragma once

#include <iosfwd>

#include "app/line_input.h"
#include "device/hardware_device.h"
#include "realtime/watchdog.h"

namespace myotact::app {

/// The guided check of one device ("myotact devices --test"): how far it reaches and which buttons it has while a
/// person moves it; after an explicit yes a push of half a newton along each axis, through the force gate as every
/// force; rate and jitter. True: every push moved the stylus its own way. `on_table`: the same device where it is real,
/// else null: it reports what it needs first (homing, for one). `watchdog`: of the device's motors, or null. Throws
/// Error Unavailable: the device does not open. Returns early, with false, when interruption() is set.
bool check_device(device::Device& device, device::HardwareDevice* on_table, realtime::Watchdog* watchdog,
                  LineInput& answers, std::ostream& out);

}  // namespace myotact::app
