#include "measure/line/line_motion.h"

#include <cmath>
#include <limits>

#include <unsupported/Eigen/MatrixFunctions>

namespace myotact::measure {
namespace {

/// Fibre lengths of all muscles at one instant.
using Fibres = std::vector<double>;

struct Instant {
  double q_rad = 0.0, velocity_rad_s = 0.0;
  Fibres fibres_m;
};

/// One step under way.
struct Step {
  const LineJoint& joint;
  const LineMotion& motion;
  simulation::TimeRule rule;
  const Instant& last;
  const Instant& before;
};

struct Pull {
  double torque_Nm = 0.0, stiffness_Nm_rad = 0.0;
};

/// Torque of all muscles at a trial angle, its slope and the fibres there.
Pull pull_at(const Step& step, double q_rad, Fibres& fibres_m) {
  Pull pull;
  for (std::size_t i = 0; i < step.joint.muscles.size(); ++i) {
    const LineMuscle& muscle = step.joint.muscles[i];
    const double level = muscle.side == Side::Flexor ? step.motion.levels.flexors : step.motion.levels.extensors;
    const PathGeometry path = measure_path(muscle.path, q_rad);
    simulation::HillStep fibre{
        path.length_m, muscle.driven ? level : 0.0, {}, step.last.fibres_m[i], step.before.fibres_m[i]};
    if (step.motion.force_velocity) fibre.rule = step.rule;
    const simulation::HillForce force = simulation::hill_step(muscle.unit, fibre);
    fibres_m[i] = force.fibre_m;
    pull.torque_Nm += path.arm_m * force.force_N;
    pull.stiffness_Nm_rad += path.arm_m * path.arm_m * force.stiffness_N_m - path.arm_slope_m_rad * force.force_N;
  }
  return pull;
}

/// Solves inertia (rate v - history) = torque(q) with v = rate q - history for the angle at the end of the step.
Instant after(const Step& step) {
  constexpr int kMostIterations = 50;
  constexpr double kConverged_rad = 1e-15;
  const simulation::TimeRule& rule = step.rule;
  const double q_history = rule.history(step.last.q_rad, step.before.q_rad);
  const double v_history = rule.history(step.last.velocity_rad_s, step.before.velocity_rad_s);
  Instant now = step.last;
  for (int i = 0; i < kMostIterations; ++i) {
    const Pull pull = pull_at(step, now.q_rad, now.fibres_m);
    now.velocity_rad_s = rule.rate_1_s * now.q_rad - q_history;
    const double missing_Nm =
        step.joint.inertia_kg_m2 * (rule.rate_1_s * now.velocity_rad_s - v_history) - pull.torque_Nm;
    const double slope = step.joint.inertia_kg_m2 * rule.rate_1_s * rule.rate_1_s + pull.stiffness_Nm_rad;
    const double move_rad = -missing_Nm / slope;
    now.q_rad += move_rad;
    if (std::abs(move_rad) <= kConverged_rad + 4.0 * std::numeric_limits<double>::epsilon() * std::abs(now.q_rad)) {
      break;
    }
  }
  return now;
}

}  // namespace

std::vector<double> move_line_joint(const LineJoint& joint, const LineMotion& motion) {
  Instant last{motion.angle_rad, motion.velocity_rad_s, {}};
  for (const LineMuscleState& muscle : line_joint_state(joint, motion.angle_rad, motion.levels).muscles) {
    last.fibres_m.push_back(muscle.force.fibre_m);
  }
  Instant before = last;
  std::vector<double> angles_rad;
  for (int i = 0; i < motion.steps; ++i) {
    const auto rule = i == 0 ? simulation::backward_euler(motion.dt_s) : simulation::second_order(motion.dt_s);
    Instant now = after({joint, motion, rule, last, before});
    before = std::move(last);
    last = std::move(now);
    angles_rad.push_back(last.q_rad);
  }
  return angles_rad;
}

std::vector<double> move_linear_joint(const LineJoint& joint, const LineJointState& state, const LineMotion& motion) {
  const Eigen::MatrixXd rates = rates_1_s(response_of(joint, state));
  const Eigen::MatrixXd over_a_step = (rates * motion.dt_s).exp();
  Eigen::VectorXd now = Eigen::VectorXd::Zero(rates.rows());
  now[1] = motion.velocity_rad_s;
  std::vector<double> angles_rad;
  for (int i = 0; i < motion.steps; ++i) {
    now = over_a_step * now;
    angles_rad.push_back(now[0]);
  }
  return angles_rad;
}

}  // namespace myotact::measure
