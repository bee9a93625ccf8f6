#include "measure/validation/pair_kinds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "measure/line/line_motion.h"
#include "simulation/curves/fibre_curves.h"

namespace myotact::measure {
namespace {

/// The path from the start on, whose constant part is still missing.
WrappedPath read_path(JsonObject& inputs) {
  constexpr double kLongest_m = 1.0;
  const auto arm = inputs.find("arm_m");
  const auto origin = inputs.find("origin_m");
  const auto insertion = inputs.find("insertion_m");
  if (arm.has_value() == (origin.has_value() && insertion.has_value())) {
    throw inputs.value().error("must have either arm_m or both origin_m and insertion_m");
  }
  WrappedPath path;
  if (arm) {  // round a cylinder, and far from where it would leave it
    path.radius_m = arm->number_between(1e-4, kLongest_m);
    path.a_m = path.b_m = 2.0 * path.radius_m;
    path.phi0_rad = std::numbers::pi;
    return path;
  }
  const auto P = origin->elements(2), D = insertion->elements(2);
  const double px = P[0].number_between(1e-6, kLongest_m), pz = P[1].number_between(1e-6, kLongest_m);
  const double dx = D[0].number_between(1e-6, kLongest_m), dz = D[1].number_between(-kLongest_m, -1e-6);
  path.a_m = std::hypot(px, pz);
  path.b_m = std::hypot(dx, dz);
  path.phi0_rad = std::atan2(pz, px) - std::atan2(dz, dx);
  return path;
}

simulation::HillMuscle read_unit(JsonObject& inputs) {
  simulation::HillMuscle unit;
  unit.peak_force_N = inputs.at("peak_force_N").number_between(1e-3, 1e6);
  unit.optimal_fibre_m = inputs.at("optimal_fibre_m").number_between(1e-4, 1.0);
  const bool elastic = inputs.at("tendon").one_of({"rigid", "elastic"}) == "elastic";
  unit.tendon = elastic ? simulation::Tendon::Elastic : simulation::Tendon::Rigid;
  unit.tendon_slack_m = inputs.at("tendon_slack_m").number_between(elastic ? 1e-4 : 0.0, 1.0);
  return unit;
}

LineJoint read_pair(JsonObject& inputs) {
  LineJoint pair;
  const auto inertia = inputs.find("inertia_kg_m2");
  pair.inertia_kg_m2 = inertia ? inertia->number_between(1e-6, 10.0) : 0.005;
  LineMuscle muscle{"flexor", Side::Flexor, true, read_path(inputs), read_unit(inputs)};
  muscle.path.sign = -1.0;
  pair.muscles.push_back(muscle);
  muscle = {"extensor", Side::Extensor, true, muscle.path, muscle.unit};
  muscle.path.sign = 1.0;
  pair.muscles.push_back(muscle);
  return pair;
}

void start_at(LineJoint& pair, double length_m) {
  for (LineMuscle& muscle : pair.muscles) {
    muscle.path.constant_m = 0.0;
    muscle.path.constant_m = length_m - measure_path(muscle.path, 0.0).length_m;
  }
}

void read_length(JsonObject& inputs, LineJoint& pair) {
  start_at(pair, inputs.at("length_m").number_between(1e-3, 2.0));
}

std::vector<double> read_activations(JsonObject& inputs) {
  std::vector<double> activations;
  for (const JsonValue& element : inputs.at("activations").elements()) {
    activations.push_back(element.number_between(0.0, 1.0));
  }
  return activations;
}

double frequency_of(const LineJoint& pair, double K_Nm_rad) {
  return std::sqrt(K_Nm_rad / pair.inertia_kg_m2) / (2.0 * std::numbers::pi);
}

struct Swing {
  double frequency_hz = std::numeric_limits<double>::quiet_NaN();
  double amplitude_kept = std::numeric_limits<double>::quiet_NaN();
};

/// From the passages through 0, placed between steps by a straight line, and the largest angles between them.
Swing swing_of(const std::vector<double>& angles_rad, double dt_s) {
  constexpr std::size_t kPassages = 11;
  std::vector<double> times_s, peaks_rad;
  double peak_rad = 0.0;
  for (std::size_t i = 1; i < angles_rad.size() && times_s.size() < kPassages; ++i) {
    peak_rad = std::max(peak_rad, std::abs(angles_rad[i]));
    if ((angles_rad[i] > 0.0) == (angles_rad[i - 1] > 0.0)) continue;
    const double share = angles_rad[i - 1] / (angles_rad[i - 1] - angles_rad[i]);
    times_s.push_back(dt_s * (static_cast<double>(i) + share));
    peaks_rad.push_back(peak_rad);
    peak_rad = 0.0;
  }
  if (times_s.size() < kPassages) return {};
  return {0.5 * (kPassages - 1) / (times_s.back() - times_s.front()), peaks_rad[kPassages - 2] / peaks_rad[1]};
}

}  // namespace

Quantities antagonist_pair(JsonObject& inputs) {
  constexpr double kNudge_rad = 1e-5;
  LineJoint pair = read_pair(inputs);
  read_length(inputs, pair);
  Quantities quantities = {{"arm_slope_m_rad", measure_path(pair.muscles[0].path, 0.0).arm_slope_m_rad}};
  for (const double a : read_activations(inputs)) {
    const LineJointState state = line_joint_state(pair, 0.0, {a, a});
    const simulation::LineJointTerms all = state.all();
    const auto torque_at = [&](double q_rad) { return line_joint_state(pair, q_rad, {a, a}).all().torque_Nm; };
    const simulation::HillForce& one = state.muscles[0].force;
    quantities[quantity_at("stretch", a)] = one.fibre_m / pair.muscles[0].unit.optimal_fibre_m;
    quantities[quantity_at("force_N", a)] = one.force_N;
    quantities[quantity_at("damping_Ns_m", a)] = one.fibre_damping_Ns_m;
    quantities[quantity_at("K", a)] = all.stiffness_Nm_rad();
    quantities[quantity_at("r2k", a)] = all.muscle_Nm_rad;
    quantities[quantity_at("geo", a)] = all.geometry_Nm_rad;
    quantities[quantity_at("B", a)] = all.damping_Nms_rad;
    quantities[quantity_at("K_error", a)] =
        all.stiffness_Nm_rad() - (torque_at(-kNudge_rad) - torque_at(kNudge_rad)) / (2.0 * kNudge_rad);
    quantities[quantity_at("frequency_hz", a)] = frequency_of(pair, all.stiffness_Nm_rad());
  }
  return quantities;
}

Quantities short_range_pair(JsonObject& inputs) {
  LineJoint pair = read_pair(inputs);
  const simulation::HillMuscle& unit = pair.muscles[0].unit;
  Quantities quantities;
  for (const double a : read_activations(inputs)) {
    simulation::HillMuscle fibres = unit;  // on a rigid tendon, for the force at their optimal length
    fibres.tendon = simulation::Tendon::Rigid;
    const double force_N = simulation::hill_equilibrium(fibres, unit.tendon_slack_m + unit.optimal_fibre_m, a).force_N;
    const double strain =
        unit.tendon == simulation::Tendon::Elastic ? simulation::tendon_strain_at(force_N / unit.peak_force_N) : 0.0;
    start_at(pair, unit.optimal_fibre_m + unit.tendon_slack_m * (1.0 + strain));
    const LineJointState state = line_joint_state(pair, 0.0, {a, a}, simulation::FibreStiffness::ShortRange);
    quantities[quantity_at("K_srs", a)] = state.all().stiffness_Nm_rad();
  }
  return quantities;
}

Quantities pair_oscillation(JsonObject& inputs) {
  constexpr double kPeriods = 7.0;
  constexpr int kMostSteps = 1'000'000;
  LineJoint pair = read_pair(inputs);
  read_length(inputs, pair);
  LineMotion motion;
  motion.angle_rad = inputs.at("amplitude_rad").number_between(1e-6, 0.5);
  motion.force_velocity = false;
  motion.dt_s = inputs.at("dt_s").number_between(1e-6, 0.01);
  Quantities quantities;
  for (const double a : read_activations(inputs)) {
    const double K_Nm_rad = line_joint_state(pair, 0.0, {a, a}).all().stiffness_Nm_rad();
    const double steps = kPeriods / (frequency_of(pair, K_Nm_rad) * motion.dt_s);
    Swing swing;
    if (steps < kMostSteps) {  // false for NaN: it would not swing
      motion.levels = {a, a};
      motion.steps = static_cast<int>(steps);
      swing = swing_of(move_line_joint(pair, motion), motion.dt_s);
    }
    quantities[quantity_at("frequency_hz", a)] = swing.frequency_hz;
    quantities[quantity_at("amplitude_kept", a)] = swing.amplitude_kept;
  }
  return quantities;
}

}  // namespace myotact::measure
