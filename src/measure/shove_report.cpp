#include "measure/shove_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace myotact::measure {
namespace {

/// Swings smaller than this part of the first are not counted as passes through rest.
constexpr double kSmallestSwing = 0.05;

/// Half periods between passes through rest, over the swing after the stroke; 0 where there are fewer than two passes.
double swing_frequency_hz(const scene::ShoveRecord& record) {
  const std::vector<double>& swing = record.swing_rad;
  double largest = 0.0;
  for (const double q : swing) largest = std::max(largest, std::abs(q));
  std::vector<double> passes_s;
  double since = 0.0;  // largest swing since the last pass
  for (std::size_t i = 1; i < swing.size(); ++i) {
    since = std::max(since, std::abs(swing[i - 1]));
    if (swing[i - 1] * swing[i] > 0.0 || swing[i - 1] == swing[i]) continue;
    if (since < kSmallestSwing * largest) continue;
    passes_s.push_back(record.dt_s * (static_cast<double>(i - 1) + swing[i - 1] / (swing[i - 1] - swing[i])));
    since = 0.0;
  }
  if (passes_s.size() < 2) return 0.0;
  return static_cast<double>(passes_s.size() - 1) / (2.0 * (passes_s.back() - passes_s.front()));
}

double swing_error(const scene::ShoveRecord& record, const JointResponse& response) {
  const auto foretold =
      struck_angles_rad(response, {record.pulse_Nm, record.pulse_s, record.dt_s}, record.swing_rad.size());
  double largest = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < foretold.size(); ++i) {
    largest = std::max(largest, std::abs(record.swing_rad[i]));
    worst = std::max(worst, std::abs(record.swing_rad[i] - foretold[i]));
  }
  return largest > 0.0 ? worst / largest : 0.0;
}

/// The joint as it was before. Line muscles answer with their fibres and tendons; finite-element muscles with their
/// quasi-static stiffness and the damping of their lines' fibres.
JointResponse response_before(const scene::ShoveRecord& record) {
  JointResponse response;
  response.inertia_kg_m2 = record.before.inertia_kg_m2;
  response.stiffness_Nm_rad = record.before.passive_Nm_rad;
  response.damping_Nms_rad = record.before.joint_damping_Nms_rad;
  for (const simulation::MuscleAtJoint& muscle : record.muscles_before) {
    if (muscle.unit) {
      add_muscle(muscle.moment_arm_m, muscle.moment_arm_slope_m_rad, *muscle.unit, response);
    } else {
      response.stiffness_Nm_rad += muscle.stiffness_Nm_rad;
      response.damping_Nms_rad += muscle.line_damping_Nms_rad;
    }
  }
  return response;
}

}  // namespace

ShoveReport report_shove(const scene::ShoveRecord& record) {
  const JointResponse response = response_before(record);
  ShoveReport report;
  report.pushed_stiffness_Nm_rad = record.pushed_stiffness_Nm_rad();
  report.read_stiffness_Nm_rad = record.before.stiffness_Nm_rad;
  report.undamped_frequency_hz =
      std::sqrt(std::max(0.0, report.read_stiffness_Nm_rad) / response.inertia_kg_m2) / (2.0 * std::numbers::pi);
  report.mode = mode_of(response);
  report.measured_frequency_hz = swing_frequency_hz(record);
  report.swing_error = swing_error(record, response);
  report.why = shove_reason(report);
  return report;
}

std::string shove_reason(const ShoveReport& report) {
  if (report.read_stiffness_Nm_rad <= 0.0) return "It does not come back: its stiffness is not above zero.";
  if (report.mode.damping_ratio >= 1.0) {
    return fmt::format(
        "It creeps back without ringing at its {:.1f} Hz: the fibres resist being moved fast more than "
        "their stiffness pulls back.",
        report.undamped_frequency_hz);
  }
  if (report.mode.damping_ratio > 0.4) {  // the second swing is under a quarter of the first
    return fmt::format("It hardly rings (damping ratio {:.2f}): the fibres resist being moved fast.",
                       report.mode.damping_ratio);
  }
  return fmt::format("It rings at {:.1f} Hz (damping ratio {:.2f}).", report.mode.frequency_hz,
                     report.mode.damping_ratio);
}

std::string shove_text(const ShoveReport& report) {
  return fmt::format(
      "Slow push: {:.2f} N m/rad (read: {:.2f}). Stroke: the swing differs from that of K, B, I and the "
      "tendons by at most {:.1f} %.\n{}",
      report.pushed_stiffness_Nm_rad, report.read_stiffness_Nm_rad, 100.0 * report.swing_error, report.why);
}

}  // namespace myotact::measure
