#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "measure/line/line_model_file.h"

namespace myotact::measure {

/// How far a hand pushes the joint from each pose for the forces at the paw.
inline constexpr double kPush_rad = 5.0 * std::numbers::pi / 180.0;

/// A joint in balance at one angle and one level of co-contraction. Stiffness is -d(torque)/dq, activations held.
struct LineRow {
  double q_rad = 0.0, level = 0.0;
  LineBalance balance;
  LineJointState state;
  double frequency_hz = 0.0;  // sqrt(K/I)/2pi; NaN when K < 0
  JointMode mode;
  double K_perturbed_Nm_rad = 0.0;    // central difference of the torque
  double K_short_range_Nm_rad = 0.0;  // with short-range stiffness
  double push_flexing_N = 0.0;        // force at the paw that holds the joint kPush_rad further flexed
  double push_extending_N = 0.0;      // the other way; both 0 without a paw lever
};

/// One row for each angle and level.
std::vector<LineRow> line_stiffness(const LineModel& model);

/// Whether K and its central difference agree to 1e-6 of K (of 1 N m/rad below).
bool agrees(const LineRow& row);

/// A figure of a row: its name, its unit and its value.
struct LineColumn {
  std::string name, unit;
  double value = 0.0;
};

/// What the model asks for: short-range stiffness and forces at the paw may be left out.
std::vector<LineColumn> line_columns(const LineModel& model, const LineRow& row);

/// Columns as in assets/cases/README.md; line_columns() and whether the balance is held.
std::string line_stiffness_csv(const LineModel& model, const std::vector<LineRow>& rows);
/// The same with the muscles of each row and the units. Missing numbers are null.
std::string line_stiffness_json(const LineModel& model, const std::vector<LineRow>& rows);

}  // namespace myotact::measure
