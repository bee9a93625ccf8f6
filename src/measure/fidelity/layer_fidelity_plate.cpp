#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.h"
#include "haptics/haptic_loop.h"
#include "measure/fidelity/layer_fidelity.h"
#include "scene/lockstep_haptics.h"

namespace myotact::measure {
namespace {

constexpr double kTick_s = 1e-3;
constexpr double kHover_s = 2.0;  // the force gate opens, the plate comes to rest
constexpr double kClose_s = 0.5;  // the hand has closed and waits
constexpr double kLift_s = 1.0, kLift_m = 0.04;
constexpr double kGap_m = 0.005;     // the stylus takes the plate from just outside
constexpr double kLastPart_s = 1.0;  // of the hold, over which the settled force is averaged
constexpr double kWithin = 0.02;     // of the weight: settled

double minimum_jerk(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

/// The plate of the scene and its hinge.
struct Plate {
  int body, surface;
  Vec3 grip_rest_m;  // on its upper face, over its centre of mass
  Vec3 hinge_m, axis;
  double weight_N;

  explicit Plate(const scene::Scene& scene) {
    const anatomy::Specimen& specimen = scene.specimen;
    if (specimen.joints.size() != 1 || specimen.joints[0].axes.empty()) {
      throw bad_data(scene.name, "/specimen", "must be a plate on one hinge, such as that of the scene plate");
    }
    const anatomy::Joint& joint = specimen.joints[0];
    body = joint.child;
    const auto bone = std::find_if(specimen.bones.begin(), specimen.bones.end(),
                                   [&](const anatomy::Bone& b) { return b.body == joint.child; });
    if (bone == specimen.bones.end()) throw bad_data(scene.name, "/specimen", "has no bone on its hinge to lift");
    surface = static_cast<int>(specimen.muscles.size()) + static_cast<int>(bone - specimen.bones.begin());
    const anatomy::Body& plate = specimen.bodies[static_cast<std::size_t>(body)];
    grip_rest_m = plate.com_m;
    for (const Vec3& x : bone->surface.positions_m) grip_rest_m.z() = std::max(grip_rest_m.z(), x.z());
    hinge_m = joint.centre_m;
    axis = joint.axes[0];
    weight_N = plate.mass_kg * scene.settings.gravity_m_s2.norm();
  }
};

struct LiftCase {
  std::string engine;
  haptics::ForceMethod method;
  double stiffness_N_m;  // of the grip: k0
  const char* grip() const { return method == haptics::ForceMethod::Pulling ? "C pulling" : "own grip"; }
  std::string name() const { return fmt::format("{} {} {:.0f} N/m", engine, grip(), stiffness_N_m); }
};

struct LiftFigures {
  double overshoot_percent = 0.0;                                // of the weight, over it, from the lift on
  double settling_s = std::numeric_limits<double>::quiet_NaN();  // after the lift's end; NaN: not within the hold
  double settled_N = 0.0;
  double ripple_N = 0.0;  // highest less lowest in the last part
  double risen_m = 0.0;
};

/// From the beginning of the lift to the end of the hold.
LiftFigures figures_of(const std::vector<LayerTick>& ticks, double weight_N, double hold_s) {
  LiftFigures figures;
  const double end_s = ticks.back().t_s;
  double most_N = 0.0, unsettled_s = end_s - hold_s, sum_N = 0.0, high_N = -1e9, low_N = 1e9;
  int counted = 0;
  for (const LayerTick& tick : ticks) {
    const double pull_N = -tick.force_N.z();
    most_N = std::max(most_N, pull_N);
    if (std::abs(pull_N - weight_N) > kWithin * weight_N) unsettled_s = std::max(unsettled_s, tick.t_s);
    if (tick.t_s < end_s - kLastPart_s) continue;
    sum_N += pull_N;
    high_N = std::max(high_N, pull_N);
    low_N = std::min(low_N, pull_N);
    ++counted;
  }
  figures.overshoot_percent = 100.0 * (most_N / weight_N - 1.0);
  if (unsettled_s < end_s - kTick_s) figures.settling_s = unsettled_s - (end_s - hold_s);
  figures.settled_N = sum_N / counted;
  figures.ripple_N = high_N - low_N;
  return figures;
}

LiftFigures lift(const LiftCase& which, const scene::Scene& scene, double hold_s, LayerFidelity::Trace& trace) {
  const Plate plate(scene);
  haptics::HapticSettings settings = scene::haptic_settings(scene.tools.front());
  settings.method = which.method;
  settings.bone.stiffness_N_m = which.stiffness_N_m;
  settings.gate.force_limit = 1.0;  // an overshoot is to show: only the device's peak cuts it
  LayerRun run(which.engine, scene, settings, plate.grip_rest_m + 4.0 * kGap_m * Vec3::UnitZ());
  const auto wait = [&](double seconds, const Vec3& target_m, std::uint32_t buttons) {
    for (int i = 0; i < std::lround(seconds / kTick_s); ++i) run.tick(target_m, Vec3::Zero(), buttons);
  };
  wait(kHover_s, plate.grip_rest_m + 4.0 * kGap_m * Vec3::UnitZ(), 0);
  const Vec3 grip_m = run.engine().body_pose(plate.surface) * plate.grip_rest_m;
  const Vec3 hand_m = grip_m + kGap_m * Vec3::UnitZ();
  wait(kClose_s, hand_m, 0);
  wait(kClose_s, hand_m, messages::kGrabBoneButton);
  const double turn_rad = kLift_m / (grip_m - plate.hinge_m).head<2>().norm();
  const auto target = [&](double t_s) {  // on the arc of the point in hand
    const Eigen::AngleAxisd rotation(turn_rad * minimum_jerk(t_s / kLift_s), plate.axis);
    return Vec3(hand_m - grip_m + plate.hinge_m + rotation * (grip_m - plate.hinge_m));
  };
  for (int i = 0; i < std::lround((kLift_s + hold_s) / kTick_s); ++i) {
    const double t_s = i * kTick_s;
    trace.ticks.push_back(
        run.tick(target(t_s), (target(t_s + kTick_s) - target(t_s)) / kTick_s, messages::kGrabBoneButton));
  }
  LiftFigures figures = figures_of(trace.ticks, plate.weight_N * settings.force_scale, hold_s);
  figures.risen_m = (run.engine().body_pose(plate.surface) * plate.grip_rest_m - grip_m).z();
  return figures;
}

}  // namespace

LayerFidelity measure_plate(const scene::Scene& scene, Effort effort) {
  const double hold_s = effort == Effort::Full ? 6.0 : 3.0;
  const double weight_N = Plate(scene).weight_N * scene.tools.front().force_scale;
  const double k0_N_m = scene.tools.front().stiffness_N_m;
  LayerFidelity fidelity;
  fidelity.title = fmt::format("{}: {:.0f} mm up in {} s, weight in the hand {:.4f} N; engines at 60 Hz, hand at 1 kHz",
                               scene.name, 1e3 * kLift_m, kLift_s, weight_N);
  fidelity.columns = {"engine",    "grip",         "k0 N/m",    "overshoot %", "settling s",
                      "settled N", "off weight %", "ripple mN", "risen mm"};
  for (const std::string& engine : layer_engines()) {
    double published_percent = 0.0;  // overshoot at the same stiffness
    for (const LiftCase& which : {LiftCase{engine, haptics::ForceMethod::Pulling, k0_N_m},
                                  LiftCase{engine, haptics::ForceMethod::Pulling, 0.25 * k0_N_m},
                                  LiftCase{engine, haptics::ForceMethod::Proxy, k0_N_m}}) {
      LayerFidelity::Trace trace{engine, fmt::format("{} {:.0f} N/m", which.grip(), which.stiffness_N_m), {}};
      const LiftFigures found = lift(which, scene, hold_s, trace);
      const double off_percent = 100.0 * (found.settled_N / weight_N - 1.0);
      fidelity.rows.push_back({engine, which.grip()});
      fidelity.values.push_back({which.stiffness_N_m, found.overshoot_percent, found.settling_s, found.settled_N,
                                 off_percent, 1e3 * found.ripple_N, 1e3 * found.risen_m});
      fidelity.figures.push_back({which.name() + ": settled force off the weight", std::abs(off_percent), "%", 2.0});
      const bool published = which.method == haptics::ForceMethod::Pulling;
      if (published && which.stiffness_N_m == k0_N_m) published_percent = found.overshoot_percent;
      if (!published) {
        fidelity.figures.push_back(
            {which.name() + ": overshoot beside that of C", found.overshoot_percent, "%", published_percent});
      }
      fidelity.traces.push_back(std::move(trace));
    }
  }
  fidelity.notes = {
      "overshoot: largest pull over the weight, from the lift on; the lift itself asks for 2.4 % of g at most.",
      "settling: from the end of the lift until the pull stays within 2 % of the weight; -: not within the hold.",
      "C feels the place that the engine published last: the age of it, times the speed of the lift, is pulled "
      "against.",
      "Only the device's peak cuts the force here, not the scene's force_limit."};
  return fidelity;
}

}  // namespace myotact::measure
