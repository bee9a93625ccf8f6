#include "measure/line/line_stiffness.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/text.h"

namespace myotact::measure {
namespace {

double torque_at_Nm(const LineJoint& joint, double q_rad, const SideLevels& levels) {
  return line_joint_state(joint, q_rad, levels).all().torque_Nm;
}

LineRow row_at(const LineModel& model, double q_rad, double level) {
  // Rounding of the torque over it is 1e-9 N m/rad, and so is what the third derivative adds.
  constexpr double kNudge_rad = 1e-5;
  const LineJoint& joint = model.joint;
  LineRow row;
  row.q_rad = q_rad;
  row.level = level;
  row.balance = balance_sides(joint, q_rad, level);
  const SideLevels& levels = row.balance.levels;
  row.state = line_joint_state(joint, q_rad, levels);
  const double K_Nm_rad = row.state.all().stiffness_Nm_rad();
  row.frequency_hz = std::sqrt(K_Nm_rad / joint.inertia_kg_m2) / (2.0 * std::numbers::pi);
  row.mode = mode_of(response_of(joint, row.state));
  row.K_perturbed_Nm_rad =
      (torque_at_Nm(joint, q_rad - kNudge_rad, levels) - torque_at_Nm(joint, q_rad + kNudge_rad, levels)) /
      (2.0 * kNudge_rad);
  row.K_short_range_Nm_rad =
      line_joint_state(joint, q_rad, levels, simulation::FibreStiffness::ShortRange).all().stiffness_Nm_rad();
  if (joint.paw_lever_m) {
    row.push_flexing_N = -torque_at_Nm(joint, q_rad + kPush_rad, levels) / *joint.paw_lever_m;
    row.push_extending_N = torque_at_Nm(joint, q_rad - kPush_rad, levels) / *joint.paw_lever_m;
  }
  return row;
}

nlohmann::ordered_json muscle_json(const LineMuscle& muscle, const LineMuscleState& state) {
  return {{"key", muscle.key},
          {"activation", state.activation},
          {"r", state.path.arm_m},
          {"dr_dq", state.path.arm_slope_m_rad},
          {"n", state.force.fibre_m / muscle.unit.optimal_fibre_m},
          {"F", state.force.force_N},
          {"k", state.force.stiffness_N_m},
          {"tendon_slack", muscle.unit.tendon_slack_m}};
}

}  // namespace

std::vector<LineRow> line_stiffness(const LineModel& model) {
  std::vector<LineRow> rows;
  for (const double q_rad : model.q_rad) {
    for (const double level : model.levels) rows.push_back(row_at(model, q_rad, level));
  }
  return rows;
}

std::vector<LineColumn> line_columns(const LineModel& model, const LineRow& row) {
  const simulation::LineJointTerms all = row.state.all();
  std::vector<LineColumn> columns = {{"q", "rad", row.q_rad},
                                     {"u", "1", row.level},
                                     {"aF", "1", row.balance.levels.flexors},
                                     {"aE", "1", row.balance.levels.extensors},
                                     {"tau", "N m", row.state.flexors.torque_Nm},
                                     {"r2k", "N m/rad", all.muscle_Nm_rad},
                                     {"geo", "N m/rad", all.geometry_Nm_rad},
                                     {"K", "N m/rad", all.stiffness_Nm_rad()},
                                     {"B", "N m s/rad", all.damping_Nms_rad},
                                     {"f", "Hz", row.frequency_hz},
                                     {"modal_f", "Hz", row.mode.frequency_hz},
                                     {"damping_ratio", "1", row.mode.damping_ratio}};
  if (model.short_range_stiffness) columns.push_back({"K_srs", "N m/rad", row.K_short_range_Nm_rad});
  if (model.joint.paw_lever_m) {
    columns.push_back({"paw_flexing", "N", row.push_flexing_N});
    columns.push_back({"paw_extending", "N", row.push_extending_N});
  }
  columns.push_back({"tau_net", "N m", all.torque_Nm});
  columns.push_back({"K_perturbed", "N m/rad", row.K_perturbed_Nm_rad});
  return columns;
}

bool agrees(const LineRow& row) {
  constexpr double kTolerance = 1e-6;
  const double K_Nm_rad = row.state.all().stiffness_Nm_rad();
  return std::abs(row.K_perturbed_Nm_rad - K_Nm_rad) <= kTolerance * std::max(1.0, std::abs(K_Nm_rad));
}

std::string line_stiffness_csv(const LineModel& model, const std::vector<LineRow>& rows) {
  std::string csv = "joint";
  for (const LineColumn& column : line_columns(model, rows.front())) csv += ',' + column.name;
  csv += ",held\n";
  for (const LineRow& row : rows) {
    csv += model.joint.name;
    for (const LineColumn& column : line_columns(model, row)) csv += ',' + to_text(column.value);
    csv += row.balance.held ? ",1\n" : ",0\n";
  }
  return csv;
}

std::string line_stiffness_json(const LineModel& model, const std::vector<LineRow>& rows) {
  nlohmann::ordered_json answer = {{"joint", model.joint.name}};
  for (const LineColumn& column : line_columns(model, rows.front())) answer["units"][column.name] = column.unit;
  for (const char* key : {"activation", "n"}) answer["units"]["muscles"][key] = "1";
  for (const char* key : {"r", "tendon_slack"}) answer["units"]["muscles"][key] = "m";
  answer["units"]["muscles"]["dr_dq"] = "m/rad";
  answer["units"]["muscles"]["F"] = "N";
  answer["units"]["muscles"]["k"] = "N/m";
  for (const LineRow& row : rows) {
    nlohmann::ordered_json line;
    for (const LineColumn& column : line_columns(model, row)) line[column.name] = column.value;
    line["held"] = row.balance.held;
    for (std::size_t i = 0; i < row.state.muscles.size(); ++i) {
      line["muscles"].push_back(muscle_json(model.joint.muscles[i], row.state.muscles[i]));
    }
    answer["rows"].push_back(line);
  }
  return answer.dump(2) + "\n";
}

}  // namespace myotact::measure
