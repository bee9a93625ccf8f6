#include "measure/validation/line_kinds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "measure/line/line_motion.h"
#include "measure/line/line_stiffness.h"
#include "measure/validation/step_count.h"

namespace myotact::measure {
namespace {

LineModel read_model(JsonObject& inputs) {
  LineModel model = load_line_model(data_folder() / "assets" / "cases" / (inputs.at("model").string() + ".json"));
  model.short_range_stiffness = true;
  model.q_rad.resize(1);
  if (const auto q = inputs.find("q_rad")) model.q_rad = {q->number_between(-1.5, 2.5)};
  const auto tendon = inputs.find("tendon");
  const bool elastic = tendon && tendon->one_of({"rigid", "elastic"}) == "elastic";
  const bool all_driven = inputs.boolean_or("all_driven", false);
  for (LineMuscle& muscle : model.joint.muscles) {
    if (tendon) muscle.unit.tendon = elastic ? simulation::Tendon::Elastic : simulation::Tendon::Rigid;
    if (all_driven) muscle.driven = true;
  }
  return model;
}

/// Gives every muscle fibres of one stretch at an angle.
void set_stretch(LineJoint& joint, double n, double q_rad) {
  for (LineMuscle& muscle : joint.muscles) {
    const double length_m = measure_path(muscle.path, q_rad).length_m;
    muscle.unit.tendon_slack_m = simulation::tendon_slack_for_m(muscle.unit, length_m, n);
  }
}

std::vector<double> read_levels(JsonObject& inputs) {
  std::vector<double> levels;
  for (const JsonValue& element : inputs.at("levels").elements()) levels.push_back(element.number_between(0.0, 1.0));
  return levels;
}

double least_stiffness_nearby(const LineJoint& joint, const LineRow& row) {
  constexpr int kDegrees = 10;
  double least_Nm_rad = row.state.all().stiffness_Nm_rad();
  for (int degree = -kDegrees; degree <= kDegrees; ++degree) {
    const double q_rad = row.q_rad + degree * std::numbers::pi / 180.0;
    const double K_Nm_rad = line_joint_state(joint, q_rad, row.balance.levels).all().stiffness_Nm_rad();
    least_Nm_rad = std::min(least_Nm_rad, K_Nm_rad);
  }
  return least_Nm_rad;
}

double stiffness_of(const LineRow& row) {
  return row.state.all().stiffness_Nm_rad();
}

void add_muscles(const LineJoint& joint, const LineJointState& state, Quantities& quantities) {
  for (std::size_t i = 0; i < joint.muscles.size(); ++i) {
    const LineMuscle& muscle = joint.muscles[i];
    quantities[fmt::format("arm({})", muscle.key)] = state.muscles[i].path.arm_m;
    quantities[fmt::format("arm_slope({})", muscle.key)] = state.muscles[i].path.arm_slope_m_rad;
    quantities[fmt::format("stretch({})", muscle.key)] = state.muscles[i].force.fibre_m / muscle.unit.optimal_fibre_m;
  }
}

}  // namespace

Quantities line_stiffness_table(JsonObject& inputs) {
  LineModel model = read_model(inputs);
  model.levels = read_levels(inputs);
  if (model.levels.empty()) throw inputs.at("levels").error("is empty; must have a level 0 .. 1");
  if (const auto n = inputs.find("stretch")) set_stretch(model.joint, n->number_between(0.2, 2.0), 0.0);
  const std::vector<LineRow> rows = line_stiffness(model);
  Quantities quantities;
  for (const LineRow& row : rows) {
    for (const LineColumn& column : line_columns(model, row)) {
      quantities[quantity_at(column.name, row.level)] = column.value;
    }
    quantities[quantity_at("K_error", row.level)] = stiffness_of(row) - row.K_perturbed_Nm_rad;
    quantities[quantity_at("least_K", row.level)] = least_stiffness_nearby(model.joint, row);
    quantities[quantity_at("held", row.level)] = row.balance.held ? 1.0 : 0.0;
  }
  quantities["factor"] = stiffness_of(rows.back()) / stiffness_of(rows.front());
  add_muscles(model.joint, rows.front().state, quantities);
  return quantities;
}

Quantities co_contraction_factors(JsonObject& inputs) {
  LineModel model = read_model(inputs);
  const int steps = inputs.at("steps").integer_between(1, 1000);
  model.levels.clear();
  for (int i = 0; i <= steps; ++i) model.levels.push_back(static_cast<double>(i) / steps);
  Quantities quantities;
  for (const JsonValue& stretch : inputs.at("stretches").elements()) {
    const double n = stretch.number_between(0.2, 2.0);
    set_stretch(model.joint, n, model.q_rad.front());
    const std::vector<LineRow> rows = line_stiffness(model);
    double least_Nm_rad = stiffness_of(rows.front());
    int falls = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      least_Nm_rad = std::min(least_Nm_rad, stiffness_of(rows[i]));
      if (stiffness_of(rows[i]) < stiffness_of(rows[i - 1])) ++falls;
    }
    quantities[quantity_at("factor", n)] = stiffness_of(rows.back()) / stiffness_of(rows.front());
    quantities[quantity_at("factor_srs", n)] = rows.back().K_short_range_Nm_rad / rows.front().K_short_range_Nm_rad;
    quantities[quantity_at("least_K", n)] = least_Nm_rad;
    quantities[quantity_at("falls", n)] = falls;
  }
  return quantities;
}

Quantities pulse_response(JsonObject& inputs) {
  const LineModel model = read_model(inputs);
  LineMotion motion;
  motion.angle_rad = model.q_rad.front();
  motion.velocity_rad_s = inputs.at("velocity_rad_s").number_between(1e-6, 100.0);
  motion.dt_s = inputs.at("dt_s").number_between(1e-6, 0.01);
  motion.steps = step_count(inputs.at("end_s"), motion.dt_s);
  Quantities quantities;
  for (const double level : read_levels(inputs)) {
    motion.levels = balance_sides(model.joint, motion.angle_rad, level).levels;
    const LineJointState state = line_joint_state(model.joint, motion.angle_rad, motion.levels);
    const std::vector<double> linear_rad = move_linear_joint(model.joint, state, motion);
    const std::vector<double> angles_rad = move_line_joint(model.joint, motion);
    double swing_rad = 0.0, departure_rad = 0.0;
    for (std::size_t i = 0; i < linear_rad.size(); ++i) {
      swing_rad = std::max(swing_rad, std::abs(linear_rad[i]));
      departure_rad = std::max(departure_rad, std::abs(angles_rad[i] - motion.angle_rad - linear_rad[i]));
    }
    quantities[quantity_at("departure", level)] = departure_rad / swing_rad;
    quantities[quantity_at("swing_rad", level)] = swing_rad;
  }
  return quantities;
}

}  // namespace myotact::measure
