#pragma once

#include "device/simulated_device.h"

namespace myotact::measure {

/// The hands of these measurements: one that holds the stylus, and none.
inline constexpr device::HandProfile kHoldingHand{0.1, 4.0, 150.0};
inline constexpr device::HandProfile kNoHand{0.0, 0.0, 0.0};

/// Stiffnesses are tried up to here.
inline constexpr double kStiffestTried_N_m = 40e3;

/// The stiffest wall, within 2 %, up to which every one tried is calm under a push of 1.5 N: at rest within 4 counts
/// and 20 um, and never softened by the buzz detector. The device's forces and own limit of stiffness
/// count for nothing here: a force that is cut would hide an instability. At most kStiffestTried_N_m.
double stiffest_calm_N_m(const device::DeviceProfile& profile, const device::HandProfile& hand);

/// The bound of haptics/gate/stiffness_bound.h for this hand: damping against tick and delay, friction against the
/// encoder.
double stiffness_bound_N_m(const device::DeviceProfile& profile, const device::HandProfile& hand);

}  // namespace myotact::measure
