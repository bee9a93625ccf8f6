#pragma once

#include <vector>

#include "core/vector.h"
#include "measure/fidelity/device_run.h"

namespace myotact::measure {

/// What the hand should have felt along a run's path, one force a tick, by playing the path again into the same scene
/// simulated with a step a tick:
///
///   device state of tick k --> [proxy] --> step of 1 ms, the tool's spring in its solve --> that spring's force
///
/// The path and the inputs of muscles and joints are those of the run. Nothing is interpolated, extrapolated or
/// late, and nothing of what makes a slow simulation usable at 1 kHz is trusted: the coupling is as stiff as tissue
/// allows (30 kN/m), no device bounds it, no observer of energy and no gate come after it; the force is the solver's.
/// What it still shares with the run is where the tool touches, whether it slips (the proxy), and the grip's own spring
/// on a bone. What swings from one tick to the next is smoothed away. `profile` is what the run was made with. Shorter
/// when stopped.
std::vector<Vec3> true_force_by_ticks(const scene::Scene& scene, const DeviceRun& run,
                                      const device::DeviceProfile& profile, const RunWatch& watch);

/// The same by what the run's own steps gave, each at the last tick before its end, straight lines between. Shows what
/// the haptic side adds to its simulation, but nothing of what the simulation's step leaves out.
std::vector<Vec3> true_force_by_steps(const DeviceRun& run);

}  // namespace myotact::measure
