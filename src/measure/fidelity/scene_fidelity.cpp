#include "measure/fidelity/scene_fidelity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "device/profile_file.h"
#include "haptics/faults.h"
#include "measure/fidelity/felt_masks.h"
#include "measure/fidelity/true_force.h"

namespace myotact::measure {

namespace {

constexpr double kTick_s = 1e-3;
constexpr double kDegrees = 180.0 / std::numbers::pi;

using TickFilter = bool (*)(const haptics::HapticTick&);

ForceSeries only(ForceSeries series, const DeviceRun& run, TickFilter wanted) {
  for (std::size_t i = 0; i < series.compared.size(); ++i)
    series.compared[i] = series.compared[i] && wanted(run.ticks[i]);
  return series;
}

/// The parts across or along the touched surface.
ForceSeries part(ForceSeries series, const DeviceRun& run, bool across) {
  for (std::size_t i = 0; i < series.true_N.size(); ++i) {
    const Vec3 normal = to_vec3(run.ticks[i].tool.contact.normal_world);
    for (Vec3* force : {&series.true_N[i], &series.commanded_N[i]}) {
      const Vec3 normal_part = force->dot(normal) * normal;
      *force = across ? normal_part : Vec3(*force - normal_part);
    }
  }
  return series;
}

std::vector<ComparedForce> compare_all(const ForceSeries& series, const DeviceRun& run) {
  std::vector<ComparedForce> compared = {{"whole force", "force", compare_forces(series)}};
  const ForceSeries contact = only(series, run, holds_contact);
  const std::vector<ComparedForce> parts = {
      {"contact", "contact", compare_forces(contact)},
      {"contact, across the surface", "contact_normal", compare_forces(part(contact, run, true))},
      {"contact, along the surface", "contact_tangential", compare_forces(part(contact, run, false))},
      {"muscle line in hand", "line", compare_forces(only(series, run, holds_line))},
      {"bone in hand", "bone", compare_forces(only(series, run, holds_bone))}};
  for (const ComparedForce& one : parts)
    if (std::isfinite(one.found.gain)) compared.push_back(one);
  return compared;
}

std::vector<StiffnessRange> all_ranges(const FidelityRequest& request) {
  std::vector<StiffnessRange> ranges = {stiffness_range(request.device, request.profile)};
  for (const std::string& name : device::built_in_profiles())
    if (name != request.device) ranges.push_back(stiffness_range(name, device::load_profile(name).profile));
  return ranges;
}

std::vector<std::string> notes_of(const SceneFidelity& fidelity, const DeviceRun& run, const FidelityRequest& request) {
  std::vector<std::string> notes;
  if (!run.notice.empty()) notes.push_back(run.notice);
  if (fidelity.force.true_N.size() < run.ticks.size())
    notes.push_back("interrupted: the truth was not played to the end");
  if (request.recording != nullptr && !request.recording->complete)
    notes.push_back(fmt::format("the recording was cut short: used up to its last whole chunk, {:.2f} s",
                                kTick_s * static_cast<double>(run.ticks.size())));
  const double stepped_s = static_cast<double>(run.steps.size());
  if (request.recording != nullptr && !run.steps.empty() && run.ticks.size() > 1) {
    const double ticks_a_step = static_cast<double>(run.ticks.size()) / stepped_s;
    notes.push_back(fmt::format("{:.1f} ticks a step: the truth gives every tick one millisecond", ticks_a_step));
  }
  std::uint32_t faults = 0;
  for (const haptics::HapticTick& tick : run.ticks) faults |= tick.tool.faults;
  for (const std::string& fault : haptics::describe_faults(faults))
    notes.push_back(fmt::format("raised while felt: {}", fault));
  if (!std::isfinite(fidelity.compared.front().found.gain))
    notes.push_back("the hand felt nothing that could be graded: no force over 20 mN for 50 ms");
  return notes;
}

/// Of the numbered goals (goals.cpp), and where they have none, less than the change of stiffness that a hand
/// begins to notice.
constexpr const char* kShareSource =
    "3 %: the goal of a line in hand; 15 %: below what a hand notices (Jones and Hunter 1990: 23 %)";

void grade_force(const ComparedForce& force, std::vector<GradedFigure>& figures) {
  const ForceComparison& c = force.found;
  const auto add = [&](const char* what, const char* unit, double value, double good, double fair, const char* source) {
    if (std::isfinite(value)) figures.push_back({force.name + ": " + what, unit, value, good, fair, source});
  };
  add("difference", "% RMS", 100.0 * c.error_rms_share, 3.0, 15.0, kShareSource);
  add("strength off by", "%", 100.0 * std::abs(c.gain - 1.0), 3.0, 15.0, kShareSource);
  add("late or early by", "ms", 1e3 * std::abs(c.lag_s), 2.0, 30.0,
      "2 ms: the goal of a line in hand; 30 ms: of a joint in hand");
  // A force rotated by an angle differs by 2 sin(angle / 2) of itself: the same shares.
  add("rotated by", "degrees", kDegrees * c.rotation_angle_rad(), 1.7, 8.6, "3 and 15 % of the force, as above");
  add("jitter over 20 Hz", "mN RMS", 1e3 * c.noise_rms_N, 10.0, 50.0,
      "10 mN: the goal of a press at rest; 50 mN: where a coupling counts as unstable");
}

}  // namespace

SceneFidelity measure_scene_fidelity(const scene::Scene& whole, const FidelityRequest& request, const RunWatch& watch) {
  const scene::Scene scene = without_effects(whole);
  const DeviceRun run = request.recording != nullptr ? run_recorded(scene, *request.recording, request.profile, watch)
                                                     : run_scripted(scene, request.profile, request.seconds, watch);
  const std::vector<Vec3> by_steps_N = true_force_by_steps(run);
  SceneFidelity result;
  result.scene = scene.name;
  result.title = scene.title;
  result.device = request.device;
  result.truth = request.truth;
  const std::vector<Vec3> true_N =
      request.truth == Truth::Ticks ? true_force_by_ticks(scene, run, request.profile, watch) : by_steps_N;
  const ComparedTicks ticks = compared_ticks(scene, run, request.profile, true_N);
  result.force = felt_series(run, true_N, ticks.compared);
  result.gate_ticks = ticks.gate;
  result.hand_ticks = ticks.hand;
  result.limit_ticks = ticks.at_limit;
  if (request.truth == Truth::Ticks) {
    ForceSeries steps = result.force;
    steps.true_N.assign(by_steps_N.begin(), by_steps_N.begin() + static_cast<std::ptrdiff_t>(true_N.size()));
    result.haptic_part = compare_forces(steps);
    steps.commanded_N = std::exchange(steps.true_N, true_N);
    result.step_part = compare_forces(steps);
  }
  result.compared = compare_all(result.force, run);
  if (result.force.true_N.size() == run.ticks.size()) {
    result.presses = press_stiffness(run, result.force);
    result.friction = sliding_friction(scene, run, result.force);
    result.joint = joint_in_hand(scene, run, result.force);
  }
  result.answer = answer_time(request.profile);
  result.ranges = all_ranges(request);
  if (request.planted.any()) result.planted = report_planted(result.force, request.planted);
  result.notes = notes_of(result, run, request);
  return result;
}

std::vector<GradedFigure> grade(const SceneFidelity& fidelity) {
  std::vector<GradedFigure> figures;
  const ForceComparison& whole = fidelity.compared.front().found;
  if (!std::isfinite(whole.gain)) return figures;
  grade_force(fidelity.compared.front(), figures);
  figures.push_back({"energy given to the hand beyond the true force's", "mJ",
                     1e3 * std::max(0.0, whole.commanded_work_J - whole.true_work_J), 1.0, 5.0,
                     "1 mJ: the goal of random poking; 5 mJ: what an observer of energy may store"});
  for (const PressStiffness& press : fidelity.presses) {
    figures.push_back(
        {fmt::format("stiffness of the press at {:.2f} s off by", press.start_s), "%",
         100.0 * std::abs(press.felt_N_m / press.true_N_m - 1.0), 5.0, 15.0,
         "5 %: the goal of felt stiffness; 15 %: below what a hand notices (Jones and Hunter 1990: 23 %)"});
  }
  figures.push_back({"answer to a step of the hand", "ms", 1e3 * fidelity.answer.total_s, 2.0, 30.0,
                     "2 ms: the goal of a line in hand; 30 ms: of a joint in hand"});
  if (fidelity.friction) {
    figures.push_back({"friction while sliding off by", "%",
                       100.0 * std::abs(fidelity.friction->felt / fidelity.friction->asked - 1.0), 4.0, 15.0,
                       "4 %: what sliding over simulated tissue is tested for; 15 %: as for stiffness"});
  }
  if (fidelity.joint) {
    figures.push_back(
        {"stiffness of the joint in hand off by", "%",
         100.0 * std::abs(fidelity.joint->felt_Nm_rad / fidelity.joint->read_Nm_rad - 1.0), 5.0, 15.0,
         "5 %: the goal of a joint in hand; 15 %: below what a hand notices (Jones and Hunter 1990: 23 %)"});
  }
  return figures;
}

Grade worst_grade(const std::vector<GradedFigure>& figures) {
  if (figures.empty()) return Grade::Unknown;
  Grade worst = Grade::Good;
  for (const GradedFigure& figure : figures) worst = std::max(worst, figure.grade());
  return worst;
}

const char* grade_text(Grade verdict) {
  constexpr std::array kTexts = {"good", "fair", "poor", "nothing to grade"};
  return kTexts[static_cast<std::size_t>(verdict)];
}

}  // namespace myotact::measure
