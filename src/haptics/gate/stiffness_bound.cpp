#include "haptics/gate/stiffness_bound.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace myotact::haptics {

namespace {

constexpr double kTick_s = 1e-3;
/// Stiffness times age at which the coupling to soft tissue begins to swing, springs in the implicit solve and local
/// compliance: 78-107 N s/m, measured with one degree of freedom: 3313 / 5336 / 7812 N/m at answers 32 / 20 / 10 ms old
/// (tests/bench/results/2026-11-22-coupling.md).
constexpr double kStiffnessByAge_Ns_m = 80.0;

}  // namespace

double StiffnessBound::smallest_N_m() const {
  return std::min({damping_N_m, quantisation_N_m, maker_N_m});
}

std::string StiffnessBound::why() const {
  if (maker_N_m <= std::min(damping_N_m, quantisation_N_m)) return "the device's own limit";
  return damping_N_m <= quantisation_N_m ? "damping of device and hand against tick and delay"
                                         : "friction against the resolution of the encoder";
}

StiffnessBound stiffness_bound(const device::DeviceProfile& profile, double hand_damping_Ns_m) {
  StiffnessBound bound;
  const double waits_s = (0.5 + std::max(0, profile.delay_ticks)) * kTick_s;
  bound.damping_N_m = (profile.viscous_Ns_m + hand_damping_Ns_m) / waits_s;
  bound.quantisation_N_m = profile.resolution_m > 0.0 ? 2.0 * profile.coulomb_N / profile.resolution_m
                                                      : std::numeric_limits<double>::infinity();
  bound.maker_N_m = profile.max_stiffness_N_m;
  return bound;
}

std::string stiffness_notice(const device::DeviceProfile& profile, double wanted_N_m) {
  const StiffnessBound bound = stiffness_bound(profile);
  if (wanted_N_m <= bound.smallest_N_m()) return {};
  return fmt::format(
      "the contact stiffness of {:.0f} N/m is lowered to {:.0f} N/m ({}); allowed: up to that; set stiffness_N_m of "
      "the tool, or take another device",
      wanted_N_m, bound.smallest_N_m(), bound.why());
}

double stiffness_by_age_N_m(double age_s) noexcept {
  return kStiffnessByAge_Ns_m / age_s;
}

}  // namespace myotact::haptics
