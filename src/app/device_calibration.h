#pragma once

#include <iosfwd>
#include <optional>

#include "app/line_input.h"
#include "device/hardware_device.h"

namespace myotact::app {

/// A device's counts for a unit of force, which its maker does not publish.
struct ForceScale {
  double value = 0.0;                  // now
  double lowest = 0.0, highest = 0.0;  // that is believed
};

struct Calibration {
  bool is_ready = false;
  std::optional<double> scale;  // that was found
};

/// The guided calibration of one device ("myotact devices --calibrate"): it shows what the device needs until
/// it is ready, and then, where its force `scale` is a setting, weighs its pull with a spring balance. No scale:
/// there is none to be found, the person did not want it or a signal came. Throws Error Unavailable.
Calibration calibrate_device(device::HardwareDevice& device, const std::optional<ForceScale>& scale, LineInput& answers,
                             std::ostream& out);

}  // namespace myotact::app
