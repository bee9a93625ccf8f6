#pragma once

#include <string>

#include "device/device.h"

namespace myotact::haptics {

/// How stiff a wall a device can render at a tick of `kTick_s`, from its profile.
struct StiffnessBound {
  double damping_N_m = 0.0;       // (b_device + b_hand) / (T/2 + delay): Colgate and Schenkel 1997, with delay
  double quantisation_N_m = 0.0;  // 2 Coulomb / resolution: Abbott and Okamura 2005
  double maker_N_m = 0.0;         // the device's own limit

  double smallest_N_m() const;
  std::string why() const;  // which of the three it is
};

/// Damping of the lightest hand that holds a stylus (1-10 N s/m by general knowledge). A stylus that is not held is
/// left to its own friction and to the observers of energy: by Colgate's bound alone no device of this class renders
/// tissue.
inline constexpr double kLightestHand_Ns_m = 1.0;

StiffnessBound stiffness_bound(const device::DeviceProfile& profile, double hand_damping_Ns_m = kLightestHand_Ns_m);

/// One line that states to what a wanted stiffness is lowered and why; empty when the device supports it.
std::string stiffness_notice(const device::DeviceProfile& profile, double wanted_N_m);

/// How stiff the coupling to a simulation may be whose answer is `age_s` old (> 0).
double stiffness_by_age_N_m(double age_s) noexcept;

}  // namespace myotact::haptics
