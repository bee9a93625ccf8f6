#pragma once

#include <string>
#include <vector>

#include "device/device.h"

namespace myotact::measure {

/// What a device profile can render, whatever the scene: its z-width.
struct StiffnessRange {
  std::string device;
  double in_hand_N_m = 0.0, no_hand_N_m = 0.0;              // stiffest calm wall
  double in_hand_bound_N_m = 0.0, no_hand_bound_N_m = 0.0;  // what theory allows (stiffness_bound.h)
  double allowed_N_m = 0.0;                                 // what the program renders at most on it
};
StiffnessRange stiffness_range(const std::string& name, const device::DeviceProfile& profile);

/// The device stands 1 mm in a wall and jumps 0.2 mm deeper between two ticks: from the tick that reads it to the one
/// from whose time on the motors pull with a force that answers (half of the change).
struct AnswerTime {
  int loop_ticks = 0;    // of the haptic loop; 0: the tick that read the step
  int device_ticks = 0;  // of the device on top
  double total_s = 0.0;  // both; the tick of sampling before is up to 1 ms more
};
AnswerTime answer_time(const device::DeviceProfile& profile);

}  // namespace myotact::measure
