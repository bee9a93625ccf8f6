#pragma once

#include <optional>
#include <vector>

#include "measure/fidelity/device_run.h"
#include "measure/fidelity/force_comparison.h"

namespace myotact::measure {

/// How stiff one press felt: slope of the normal force over the way of the device along the normal, while it loads
/// from a fifth to nine tenths of the most.
struct PressStiffness {
  double start_s = 0.0, depth_m = 0.0;
  double felt_N_m = 0.0, true_N_m = 0.0;
};
/// Of every touch of a surface that loads by at least 0.1 N and 0.3 mm while the hand goes into it more than along it.
/// `series` is that of the run.
std::vector<PressStiffness> press_stiffness(const DeviceRun& run, const ForceSeries& series);

/// Force along the surface over force across it while the tool slips faster than 5 mm/s for 50 ms and more.
struct SlidingFriction {
  std::size_t ticks = 0;
  double felt = 0.0, simulated = 0.0;
  double asked = 0.0;  // by the scene, at those speeds
};
/// Nothing without a slide, or where the scene's friction has a direction or a viscous part.
std::optional<SlidingFriction> sliding_friction(const scene::Scene& scene, const DeviceRun& run,
                                                const ForceSeries& series);

/// A joint rotated by a bone in hand: torque of the felt force fitted to K times angle and B times speed.
struct JointInHand {
  double felt_Nm_rad = 0.0, read_Nm_rad = 0.0;  // K by the force, K that the simulation shows (mean)
  double range_rad = 0.0;                       // of the angle
};
/// Nothing unless the co-contracted joint rotates by half a degree with the hand on a bone, its K within 5 %
/// throughout.
std::optional<JointInHand> joint_in_hand(const scene::Scene& scene, const DeviceRun& run, const ForceSeries& series);

}  // namespace myotact::measure
