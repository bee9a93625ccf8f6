#include "measure/fidelity/calm_stiffness.h"

#include <algorithm>
#include <cmath>

#include "haptics/faults.h"
#include "haptics/gate/stiffness_bound.h"
#include "measure/fidelity/virtual_touch.h"

namespace myotact::measure {

namespace {

constexpr double kPush_N = 1.5;

device::DeviceProfile uncut(device::DeviceProfile profile) {
  profile.peak_force_N = profile.continuous_force_N = 20.0;  // the upper end of the class
  profile.max_stiffness_N_m = kStiffestTried_N_m;
  return profile;
}

bool is_calm(const device::DeviceProfile& profile, const device::HandProfile& hand, double stiffness_N_m) {
  haptics::HapticSettings settings;
  settings.limit_stiffness = false;
  settings.gate.ramp_s = 0.05;
  settings.gate.force_limit = 1.0;
  settings.contact.stiffness_N_m = stiffness_N_m;
  const double start_m = settings.contact.radius_m + 2e-4;
  VirtualTouch touch({}, Vec3(0.0, 0.0, start_m), profile, hand, settings);
  for (int i = 0; i < 100; ++i) touch.tick();
  double lowest_m = 1.0, highest_m = -1.0;
  constexpr int kTicks = 2500, kJudged = 500;
  for (int i = 0; i < kTicks; ++i) {
    device::HandTarget target{{0.0, 0.0, start_m}, {}, 0};
    target.push_world_N = {0.0, 0.0, -kPush_N};
    touch.device.set_hand_target(target);
    touch.tick();
    if ((touch.loop.tool_state().faults & haptics::bit(haptics::Fault::Buzz)) != 0) return false;
    if (i < kTicks - kJudged) continue;
    lowest_m = std::min(lowest_m, touch.device.position_world_m().z());
    highest_m = std::max(highest_m, touch.device.position_world_m().z());
  }
  return highest_m - lowest_m < std::max(4.0 * profile.resolution_m, 20e-6);
}

}  // namespace

double stiffest_calm_N_m(const device::DeviceProfile& as_sold, const device::HandProfile& hand) {
  const device::DeviceProfile profile = uncut(as_sold);
  double calm = 20.0;
  while (calm < kStiffestTried_N_m && is_calm(profile, hand, 1.25 * calm)) calm *= 1.25;
  if (calm >= kStiffestTried_N_m) return kStiffestTried_N_m;
  double restless = 1.25 * calm;
  while (restless / calm > 1.02) {
    const double middle = std::sqrt(calm * restless);
    (is_calm(profile, hand, middle) ? calm : restless) = middle;
  }
  return calm;
}

double stiffness_bound_N_m(const device::DeviceProfile& profile, const device::HandProfile& hand) {
  const haptics::StiffnessBound bound = haptics::stiffness_bound(profile, hand.damping_Ns_m);
  return std::min(bound.damping_N_m, bound.quantisation_N_m);
}

}  // namespace myotact::measure
