#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/vector.h"
#include "haptics/haptic_loop.h"
#include "scene/conductor.h"
#include "scene/recording.h"
#include "scene/scene_file.h"

namespace myotact::measure {

/// Progress and stop of long work, called between its steps.
struct RunWatch {
  std::function<void(int done, int all)> progress;
  std::function<bool()> stopped;  // true, once and for good: end here, with what there is
};

/// What the first tool's hand felt along a path of its device, and the inputs and outputs of the simulation meanwhile.
/// A second hand acts beside it.
struct DeviceRun {
  std::vector<haptics::HapticTick> ticks;  // 1 ms apart
  /// Where the hand was at each tick: of a simulated device the truth behind its encoder; of a recorded one its counts
  /// smoothed over 5 ms either way. A count of 20 um alone makes 40 mN of jitter on tissue that 1 ms cannot move.
  std::vector<Vec3> hand_m;
  std::vector<std::size_t> step_of_tick;         // the step that was under way, in `steps`
  std::vector<scene::StepRecord> steps;          // their hashes are left out
  std::vector<Vec3> step_force_N;                // of the simulation on the hand at the end of each step, scaled
  std::vector<simulation::JointReadout> joints;  // the scene's co-contracted one after each step; empty without one
  std::string notice;                            // what the device does not support of the scene's settings
};

/// The scene without what is only for the hand and no force of the simulation: texture (texture_goals.h measures it)
/// and the snap of lines.
scene::Scene without_effects(scene::Scene scene);

/// Where the hands are, from when the path begins.
struct HandPath {
  std::function<scene::HandTarget(std::size_t tool, double time_s)> hand;
  double end_s = 0.0;
};

/// A scene that has been put where a path is to begin.
struct StandingScene {
  const scene::Scene& scene;
  simulation::Simulation& simulation;
  scene::Conductor& conductor;  // of this simulation
};

/// A path in lockstep by simulated hands on devices of this profile. The force gate has opened before it begins.
DeviceRun run_along(const StandingScene& standing, const device::DeviceProfile& profile, const HandPath& path,
                    const RunWatch& watch);

/// The scene's script in lockstep, for at most `seconds`, as run_along().
DeviceRun run_scripted(const scene::Scene& scene, const device::DeviceProfile& profile, double seconds,
                       const RunWatch& watch);

/// A recorded path, felt again against the simulation that is run again beside it.
DeviceRun run_recorded(const scene::Scene& scene, const scene::Recording& recording,
                       const device::DeviceProfile& profile, const RunWatch& watch);

/// Force of the simulation on the hand at the end of the step that made `model` and consumed `tool`, scaled [N]:
/// the springs of contact and bone as the implicit solve had them, and the pull of the line in hand.
Vec3 simulated_force_N(const messages::LocalModel& model, const messages::ToolState& tool, double force_scale);

}  // namespace myotact::measure
