#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/fidelity/device_figures.h"
#include "measure/fidelity/felt_quantities.h"
#include "measure/fidelity/planted_faults.h"

namespace myotact::measure {

/// What counts as the true force; true_force.h states how each is computed.
enum class Truth { Steps, Ticks };

struct FidelityRequest {
  std::string device = "simulated";
  device::DeviceProfile profile;
  double seconds = 1e9;                         // of a script at most
  const scene::Recording* recording = nullptr;  // in place of the script
  Truth truth = Truth::Steps;
  PlantedFaults planted;
};

/// One quantity of the force over the ticks that it is about.
struct ComparedForce {
  std::string name;  // e.g. "contact, across the surface"
  std::string key;   // for JSON
  ForceComparison found;
};

enum class Grade { Good, Fair, Poor, Unknown };

/// One figure beside the two bounds that make it good or fair.
struct GradedFigure {
  std::string name, unit;
  double value = 0.0;
  double good = 0.0, fair = 0.0;  // at most
  std::string source;             // of the bounds
  Grade grade() const { return value <= good ? Grade::Good : value <= fair ? Grade::Fair : Grade::Poor; }
};

struct SceneFidelity {
  std::string scene, title, device;
  Truth truth = Truth::Steps;
  ForceSeries force;  // commanded (as felt, nothing planted) and true, one entry a tick; shorter when stopped
  std::size_t gate_ticks = 0, hand_ticks = 0, limit_ticks = 0;  // left out, and why (felt_masks.h)
  std::vector<ComparedForce> compared;                          // the first is the whole force
  /// With Truth::Ticks, of the whole difference: what the haptic side adds to its simulation, and what the simulation's
  /// step leaves out.
  std::optional<ForceComparison> haptic_part, step_part;
  std::vector<PressStiffness> presses;
  std::optional<SlidingFriction> friction;
  std::optional<JointInHand> joint;
  AnswerTime answer;                   // of the device
  std::vector<StiffnessRange> ranges;  // the device first, then those of assets/devices
  std::optional<PlantedReport> planted;
  std::vector<std::string> notes;  // what a reader has to know
};

/// Runs the scene (or feels the recording again), gets the truth and compares. Texture and the snap of lines are left
/// out. Throws Error.
SceneFidelity measure_scene_fidelity(const scene::Scene& scene, const FidelityRequest& request, const RunWatch& watch);

/// The figures that make the verdict; those that the run does not determine are left out, and all
/// where nothing was felt.
std::vector<GradedFigure> grade(const SceneFidelity& fidelity);

/// The worst of them; Unknown for none: nothing was felt.
Grade worst_grade(const std::vector<GradedFigure>& figures);
const char* grade_text(Grade verdict);

}  // namespace myotact::measure
