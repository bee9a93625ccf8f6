#include "scene/co_contraction.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact::scene {

namespace {

/// Denser towards 0, where the joint is soft: an error of 0.02 N m rotates the canine stifle by 2 degrees there.
const std::vector<double> kLevels = {0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.65, 0.8, 1.0};

/// What is left over is trimmed away at this rate and, so that the lag of activation and tissue (some 0.05 s together)
/// does not make that swing, by this share at once. Twice as much sets finite elements swinging where they are soft.
constexpr double kTrimRate_1_s = 10.0;
constexpr double kTrimShare = 0.5;
/// Farther from the held angle the present stiffness does not determine the torque there. What is left over is then
/// taken from the angle alone, more slowly: this far away such a trim counts as stiffness.
constexpr double kTrimReach_rad = 0.05;
constexpr double kFarTrimRate_1_s = 2.0;
/// Least stiffness that the trim reckons with: a joint that is limp or unstable is still led back.
constexpr double kTrimStiffness_Nm_rad = 0.1;

double side_torque(const TorqueTable& table, const std::vector<int>& side, double activation) {
  double sum = 0.0;
  for (const int muscle : side) sum += table.torque(muscle, activation);
  return sum;
}

bool contains(const std::vector<int>& side, int muscle) {
  return std::find(side.begin(), side.end(), muscle) != side.end();
}

/// Zero of a function that changes sign at most once on [low, high]; the nearer end when it does not change sign.
double bisect(const std::function<double(double)>& residual, double low, double high) {
  const double at_low = residual(low);
  const double at_high = residual(high);
  if (at_low * at_high > 0.0) return std::abs(at_low) <= std::abs(at_high) ? low : high;
  for (int i = 0; i < 60; ++i) {  // 2^-60: beyond the resolution of a double on [0, 1]
    const double middle = 0.5 * (low + high);
    (residual(middle) * at_low > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double TorqueTable::torque(int muscle, double activation) const {
  const auto& row = torque_Nm[static_cast<std::size_t>(muscle)];
  const double a = std::clamp(activation, 0.0, 1.0);
  const auto above = std::upper_bound(levels.begin(), levels.end() - 1, a);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - levels.begin(), 1));
  const double s = (a - levels[i - 1]) / (levels[i] - levels[i - 1]);
  return (1.0 - s) * row[i - 1] + s * row[i];
}

CoContraction co_contraction_of(const Scene& scene, const std::string& joint_key) {
  const anatomy::Specimen& specimen = scene.specimen;
  const int joint = anatomy::find_joint(specimen, joint_key);
  if (scene.co_contraction && joint == scene.co_contraction->joint) return *scene.co_contraction;
  std::vector<std::string> keys;
  for (const anatomy::MuscleGroup& group : specimen.groups) {
    const anatomy::Joint& candidate = specimen.joints[static_cast<std::size_t>(group.joint)];
    if (candidate.type != anatomy::JointType::Hinge || group.flexors.empty() || group.extensors.empty()) continue;
    keys.push_back(candidate.key);
    if (group.joint != joint) continue;
    CoContraction set;
    set.joint = joint;
    set.flexors = group.flexors;
    set.extensors = group.extensors;
    return set;
  }
  const std::string problem = joint < 0 ? "the specimen has no such joint"
                                        : "this joint does not rotate or lacks flexors or extensors in the specimen";
  throw Error(ExitStatus::Usage,
              fmt::format("--joint {}: {}; joints of {} whose stiffness can be measured: {} (nearest: {})", joint_key,
                          problem, specimen.name, join(keys), nearest_word(joint_key, keys)));
}

TorqueTable measure_torques(const Scene& scene, simulation::Simulation& simulation,
                            std::span<const double> angles_rad) {
  const CoContraction& set = *scene.co_contraction;
  TorqueTable table{kLevels, std::vector<std::vector<double>>(scene.specimen.muscles.size())};
  const auto settle = [&](const std::vector<double>& activations, double level) {
    if (!simulation.settle(angles_rad, activations) && !table.unsettled_level) table.unsettled_level = level;
  };
  for (const double level : kLevels) {
    std::vector<double> activations = scene.activations;
    for (const int m : set.flexors) activations[static_cast<std::size_t>(m)] = level;
    for (const int m : set.extensors) activations[static_cast<std::size_t>(m)] = level;
    settle(activations, level);
    for (std::size_t m = 0; m < table.torque_Nm.size(); ++m) {
      table.torque_Nm[m].push_back(simulation.muscle_torque_Nm(static_cast<int>(m), set.joint));
    }
  }
  simulation.restart();  // full activation to none at once: from the file pose the way is shorter
  settle(scene.activations, 0.0);
  return table;
}

Balance balance(const TorqueTable& table, const CoContraction& set, std::span<const double> activations,
                double wanted_Nm) {
  double others = 0.0;
  for (std::size_t m = 0; m < activations.size(); ++m) {
    const int muscle = static_cast<int>(m);
    if (contains(set.flexors, muscle) || contains(set.extensors, muscle)) continue;
    others += table.torque(muscle, activations[m]);
  }
  const bool flexors_weaker =
      std::abs(side_torque(table, set.flexors, 1.0)) < std::abs(side_torque(table, set.extensors, 1.0));
  const auto& weak = flexors_weaker ? set.flexors : set.extensors;
  const auto& strong = flexors_weaker ? set.extensors : set.flexors;
  const auto net = [&](double weak_level, double strong_level) {
    return others + side_torque(table, weak, weak_level) + side_torque(table, strong, strong_level) - wanted_Nm;
  };
  const double sign = flexors_weaker ? 1.0 : -1.0;  // of the weak side's torque
  double weak_level = set.common;
  double strong_level = 0.0;
  if (sign * net(set.common, 0.0) >= 0.0) {
    strong_level = bisect([&](double level) { return net(set.common, level); }, 0.0, 1.0);
  } else {
    weak_level = bisect([&](double level) { return net(level, 0.0); }, set.common, 1.0);
  }
  constexpr double kHeld_Nm = 1e-6;
  Balance result{flexors_weaker ? weak_level : strong_level, flexors_weaker ? strong_level : weak_level,
                 std::abs(net(weak_level, strong_level)) < kHeld_Nm};
  result.flexors = std::clamp(result.flexors + std::max(set.difference, 0.0), 0.0, 1.0);
  result.extensors = std::clamp(result.extensors + std::max(-set.difference, 0.0), 0.0, 1.0);
  return result;
}

std::vector<double> driven_activations(const CoContraction& set, const Balance& levels,
                                       std::vector<double> activations) {
  for (const int m : set.flexors) activations[static_cast<std::size_t>(m)] = levels.flexors;
  for (const int m : set.extensors) activations[static_cast<std::size_t>(m)] = levels.extensors;
  return activations;
}

void PostureTrim::restart(const simulation::JointReadout& joint) {
  held_angle_rad_ = joint.angle_rad;
  torque_Nm_ = -joint.own_torque_Nm;
  left_over_Nm_ = 0.0;
}

void PostureTrim::correct(const simulation::JointReadout& settled) {
  torque_Nm_ -= settled.net_torque_Nm + settled.own_torque_Nm;
}

double PostureTrim::update(const simulation::JointReadout& joint, double dt_s) {
  const double drift_rad = joint.angle_rad - held_angle_rad_;
  const double restored_Nm = std::max(joint.stiffness_Nm_rad, kTrimStiffness_Nm_rad) * drift_rad;
  if (std::abs(drift_rad) > kTrimReach_rad) {
    torque_Nm_ -= kFarTrimRate_1_s * restored_Nm * dt_s;
  } else {
    const double left_over_Nm = joint.net_torque_Nm + joint.own_torque_Nm + restored_Nm;
    torque_Nm_ -= kTrimRate_1_s * left_over_Nm * dt_s + kTrimShare * (left_over_Nm - left_over_Nm_);
    left_over_Nm_ = left_over_Nm;
  }
  return torque_Nm_;
}

}  // namespace myotact::scene
