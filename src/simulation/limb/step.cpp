#include "simulation/limb/step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include "core/at.h"
#include "simulation/limb/coupled_solve.h"
#include "simulation/limb/find_touches.h"
#include "simulation/limb/sleep.h"
#include "simulation/limb/small_system.h"

namespace myotact::simulation {
namespace {

/// Newton steps at most; the second one is needed only when a hand yanks or an activation jumps, more than three where
/// a hand presses slack muscles that lie on each other.
constexpr int kMostIterations = 5;
/// Out-of-balance force, over the size of the elements' forces, at which a step counts as solved. Below the 3 % that
/// one linearised step costs in force anyway (measured on twitches against steps of 1 ms).
constexpr double kSolvedShare = 0.02;
/// A muscle that one Newton step has brought below this share has hardly changed: the next step begins with the same
/// tangent. Its forces are always new: what the tangent has wrong is left as residual, and the next step makes it good.
/// While an elbow is pressed and contracts, nine of ten tangents are kept and no node comes out more than 0.08 mm
/// beside where new ones bring it (0.28 mm with 3e-4, which keeps one more in a hundred).
constexpr double kKeptShare = 1e-4;
/// Share to which the coupling of touching muscles is solved: a quarter of what counts as solved.
constexpr double kCoupledShare = 0.005;
/// The same in a static step, over the share that it starts from: each step then gains two digits at most.
constexpr double kRelaxedPart = 0.01;
/// Out-of-balance torque of the joints, over the sum of the lines' torques, at which Line muscles count as solved: they
/// cost next to nothing, so that one more step of Newton's is worth a figure's fourth digit.
constexpr double kLinesSolvedShare = 1e-4;
/// A joint that rotates farther than this in one Newton step is linearised once more [rad].
constexpr double kLargestRotation_rad = 0.05;
/// A place where an element folds over farther than this is not looked at.
constexpr double kSmallestJ = -0.5;
/// A Newton step ends where the energy rises by less than this part of how steeply it fell at the start.
constexpr double kSteepestRise = 0.5;
constexpr int kMostCuts = 5;
/// Part of the way to a place where something folds over that is tried next.
constexpr double kUnsoundShare = 0.3;
/// Part of its last velocity with which everything is carried on to where a step's first tangent is made. In 3 s of the
/// scene `forelimb` 420 Newton steps instead of 513 with none of it. The whole of it overshoots where a hand or a
/// surface stops what moved: 1606 instead of 1034 in 5 s of pressing muscles that lie on each other (1013 with none).
constexpr double kCarriedOn = 0.7;

/// The Newton step from the instant where it was computed: start + part * change.
struct Way {
  Eigen::VectorXd start_rad, change_rad;  // joints; the nodes' are in the muscles
};

/// Solutions of the small system.
struct Solutions {
  const Eigen::VectorXd& uncoupled;  // with each muscle for itself
  const Eigen::VectorXd& coupled;    // with the contact between them
};

/// How far a muscle is from balance, tool springs included, and the slope of its energy along the way.
void weigh(const Limb& limb, int index, LimbMuscle& muscle) {
  Eigen::VectorXd unbalanced = muscle.system.residual_N;
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    const ToolSpring& spring = limb.springs[s];
    if (spring.muscle != index) continue;
    const Vec3 force = spring_force(limb, s);
    for (std::size_t k = 0; k < at(spring.point.count); ++k) {
      const int f = muscle.tissue.free_index[at(spring.point.nodes[k])];
      if (f >= 0) unbalanced.segment<3>(3 * f) -= spring.point.weights[k] * force;
    }
  }
  muscle.energy_slope = unbalanced.dot(muscle.change_m);
  muscle.residual_share = unbalanced.norm() / (muscle.system.force_scale_N + 1e-6);
  muscle.sound = std::isfinite(muscle.residual_share) && muscle.system.smallest_J > kSmallestJ;
}

/// The muscle's part of the way, and how its energy falls at the start.
void start_way(const Limb& limb, const Solutions& solutions, int index, LimbMuscle& muscle) {
  muscle.start_m = muscle.state.now.position_m;
  muscle.change_m = -muscle.free_solution;
  muscle.change_m.noalias() -= muscle.border_solution * solutions.uncoupled(muscle.unknowns);
  if (muscle.coupled_m.size() > 0) muscle.change_m += muscle.coupled_m;
  weigh(limb, index, muscle);
}

/// Moves all muscles' nodes along the way.
void move_nodes(Limb& limb, double part) {
  for (LimbMuscle& muscle : limb.muscles) {
    if (!is_solved(muscle)) continue;
    muscle.state.now.position_m = muscle.start_m;
    move_free_nodes(muscle, part * muscle.change_m);
    place_clamped(muscle.tissue, limb.skeleton, muscle.state);
  }
  see_neighbours(limb);
}

/// A muscle's forces in its present place.
void evaluate(const Limb& limb, const TissueLoad& load, int index, LimbMuscle& muscle) {
  compute_forces(muscle.tissue, limb.skeleton, load, muscle.state, muscle.system);
  weigh(limb, index, muscle);
}

/// Slope of the step's energy along the way at the present place; what is done by springs through the joints included.
double energy_slope(Limb& limb, const TimeRule& rule, const Way& way) {
  double slope = skeleton_residual(limb, rule).dot(way.change_rad);
  for (const LimbMuscle& muscle : limb.muscles) {
    if (is_solved(muscle)) slope += muscle.energy_slope;
    if (!only_follows(muscle)) slope += muscle.system.joint_residual_Nm.dot(way.change_rad);
  }
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    const ToolSpring& spring = limb.springs[s];
    const Vec3 force = spring_force(limb, s);
    for (int j = 0; j < limb.skeleton.joint_count(); ++j) {
      slope -= force.dot(spring_slope(limb, spring, j)) * way.change_rad[j];
    }
  }
  return slope;
}

/// Puts the limb at a part of the way. False when something is not finite or folded over.
bool go(Limb& limb, const TissueLoad& load, const Way& way, double part, WorkerPool& workers) {
  limb.now.angle_rad = way.start_rad + part * way.change_rad;
  follow_angles(limb);
  evaluate_lines(limb, load.rule);
  evaluate_sleepers(limb, load.rule);
  move_nodes(limb, part);
  workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
    if (is_solved(limb.muscles[at(m)])) evaluate(limb, load, m, limb.muscles[at(m)]);
  });
  return std::all_of(limb.muscles.begin(), limb.muscles.end(),
                     [](const LimbMuscle& m) { return !is_solved(m) || m.sound; });
}

/// The way that the small system's solutions mean; all muscles' start and change.
Way make_way(Limb& limb, const SmallSystem& small, const Solutions& solutions, WorkerPool& workers) {
  Way way{limb.now.angle_rad, Eigen::VectorXd::Zero(limb.skeleton.joint_count())};
  for (std::size_t a = 0; a < small.joints.size(); ++a) {
    way.change_rad[small.joints[a]] = solutions.coupled[static_cast<Eigen::Index>(a)];
  }
  workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
    if (is_solved(limb.muscles[at(m)])) start_way(limb, solutions, m, limb.muscles[at(m)]);
  });
  return way;
}

/// A place on the way.
struct Place {
  double part = 0.0;
  double slope = 0.0;  // of the energy; not a number where the limb is not sound
};

/// Where the slope between two places is zero, were it a straight line; not too near to either.
double part_between(const Place& before, const Place& beyond) {
  const double share = std::isfinite(beyond.slope) ? before.slope / (before.slope - beyond.slope) : kUnsoundShare;
  return before.part + std::clamp(share, 0.1, 0.8) * (beyond.part - before.part);
}

/// Goes the whole way unless the energy rises steeply by then; then to where it is lowest, or nearly: surfaces that
/// close on the way have no slope at its start, and a step that ends before they close would bring the next one no
/// farther. `part`: how much of it at most, then how much was gone.
bool search_way(Limb& limb, const TissueLoad& load, const Way& way, WorkerPool& workers, double& part) {
  Place before{0.0, energy_slope(limb, load.rule, way)};
  const double steep = kSteepestRise * -before.slope;
  std::optional<Place> beyond;
  for (int cut = 0; cut < kMostCuts; ++cut) {
    const bool sound = go(limb, load, way, part, workers);
    const Place here{part, sound ? energy_slope(limb, load.rule, way) : std::numeric_limits<double>::quiet_NaN()};
    const bool rises = here.slope >= steep, falls = beyond && here.slope <= -steep;
    if (sound && (steep <= 0.0 || (!rises && !falls))) return true;
    if (here.slope < 0.0) {
      before = here;
    } else {
      beyond = here;
    }
    part = part_between(before, *beyond);
  }
  return go(limb, load, way, part, workers);
}

struct Iteration {
  bool sound = true;
  double residual_share = 0.0;
  double lines_share = 0.0;  // of the joints' balance, where only lines and bones have a part in it
  double rotation_rad = 0.0;
  double part = 1.0;  // of the way that was gone
};

/// Out-of-balance torque of the joints that may rotate over the sizes of the lines' torques; 0 where finite elements or
/// springs have a part in the balance, which the muscles' own residuals then show.
double lines_share(Limb& limb, const TimeRule& rule) {
  double scale_Nm = 0.0;
  for (const LimbMuscle& muscle : limb.muscles) {
    if (!muscle.rigid) return 0.0;
    if (muscle.line) scale_Nm += muscle.system.joint_residual_Nm.cwiseAbs().maxCoeff();
  }
  const auto pulls = [](const ToolSpring& spring) { return !spring.ahead; };
  if (scale_Nm == 0.0 || std::any_of(limb.springs.begin(), limb.springs.end(), pulls)) return 0.0;
  Eigen::VectorXd residual_Nm = skeleton_residual(limb, rule);
  for (const LimbMuscle& muscle : limb.muscles) {
    if (muscle.line) residual_Nm += muscle.system.joint_residual_Nm;
  }
  double worst_Nm = 0.0;
  for (int j = 0; j < limb.skeleton.joint_count(); ++j) {
    if (limb.skeleton.moves(j)) worst_Nm = std::max(worst_Nm, std::abs(residual_Nm[j]));
  }
  return worst_Nm / scale_Nm;
}

/// What a Newton step solves.
struct Task {
  const TissueLoad& load;
  Joints joints = Joints::Free;
  double coupled_share = kCoupledShare;
  double farthest_m = std::numeric_limits<double>::infinity();  // that a node may go
};

/// The part of the way on which no node goes farther than it may.
double allowed_part(const Limb& limb, double farthest_m) {
  double longest_m = 0.0;
  for (const LimbMuscle& muscle : limb.muscles) {
    if (!is_solved(muscle) || muscle.change_m.size() == 0) continue;
    longest_m = std::max(longest_m, muscle.change_m.reshaped(3, muscle.tissue.free_nodes).colwise().norm().maxCoeff());
  }
  return longest_m > farthest_m ? farthest_m / longest_m : 1.0;
}

/// The muscles to eliminate, those first that take longest: whoever works at the last one keeps all others waiting.
std::vector<int> longest_first(const Limb& limb, const TimeRule& rule) {
  std::vector<int> order;
  for (int m = 0; m < static_cast<int>(limb.muscles.size()); ++m) {
    if (is_solved(limb.muscles[at(m)])) order.push_back(m);
  }
  const auto cost = [&](int m) {
    const LimbMuscle& muscle = limb.muscles[at(m)];
    const bool factored = muscle.balanced || muscle.kept_rule == rule;
    return std::pair(factored ? 0 : 1, muscle.tissue.free_nodes);
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return cost(a) > cost(b); });
  return order;
}

Iteration newton_step(Limb& limb, const Task& task, WorkerPool& workers, int& definite_solves) {
  const TissueLoad& load = task.load;
  close_springs(limb);
  SmallSystem small = make_small_system(limb, task.joints);
  const std::vector<int> order = longest_first(limb, load.rule);
  workers.run(static_cast<int>(order.size()), [&](int k) {
    const int m = order[at(k)];
    eliminate(limb, small, load, m, limb.muscles[at(m)]);
  });
  for (const LimbMuscle& muscle : limb.muscles) {
    if (!is_solved(muscle)) continue;
    if (!muscle.sound) return {false};
    definite_solves += muscle.made_definite;
  }
  add_up(limb, load.rule, small);
  Eigen::PartialPivLU<Eigen::MatrixXd> factor(small.matrix);
  Eigen::VectorXd uncoupled = small.size() > 0 ? Eigen::VectorXd(factor.solve(small.right)) : small.right;
  while (open_pulling(limb, uncoupled, small)) {
    add_up(limb, load.rule, small);
    factor.compute(small.matrix);
    uncoupled = factor.solve(small.right);
  }
  if (!uncoupled.allFinite()) return {false};
  Eigen::VectorXd solution = uncoupled;
  couple_step(limb, factor, task.coupled_share, solution, workers);

  const Way way = make_way(limb, small, {uncoupled, solution}, workers);
  Iteration result;
  result.part = allowed_part(limb, task.farthest_m);
  result.sound = search_way(limb, load, way, workers, result.part);
  result.lines_share = lines_share(limb, load.rule);
  if (way.change_rad.size() > 0) result.rotation_rad = way.change_rad.cwiseAbs().maxCoeff();
  for (LimbMuscle& muscle : limb.muscles) {
    if (!is_solved(muscle)) continue;
    result.residual_share = std::max(result.residual_share, muscle.residual_share);
    muscle.balanced = muscle.residual_share < kSolvedShare;
    if (!muscle.balanced) muscle.kept_rule.reset();
    muscle.strained |= !muscle.balanced;
  }
  return result;
}

/// Rates that the next step starts from.
void finish(Limb& limb, const TimeRule& rule) {
  limb.now.velocity_rad_s = joint_velocity_rad_s(limb, rule);
  for (LimbMuscle& muscle : limb.muscles) {
    if (muscle.sleep) continue;
    TissueState& state = muscle.state;
    for (std::size_t p = 0; p < state.stretch_rate_1_s.size(); ++p) {
      state.stretch_rate_1_s[p] =
          rule.rate_1_s * state.now.stretch[p] - rule.history(state.last.stretch[p], state.before.stretch[p]);
    }
  }
  for (std::size_t s = 0; s < limb.springs.size(); ++s) limb.spring_force_N[s] = spring_force(limb, s);
  read_out(limb);
}

/// Puts the limb where its velocity would have it, so that what closes or opens during the step is seen by its first
/// tangent.
void carry_on(Limb& limb, double time_s) {
  for (int j = 0; j < limb.skeleton.joint_count(); ++j) {
    if (limb.skeleton.moves(j)) limb.now.angle_rad[j] += time_s * limb.last.velocity_rad_s[j];
  }
  for (LimbMuscle& muscle : limb.muscles) {
    if (is_solved(muscle)) muscle.state.now.position_m += time_s * muscle.state.last.velocity_m_s;
  }
}

}  // namespace

StepReport advance(Limb& limb, const StepInput& input, WorkerPool& workers) {
  TissueLoad load;
  load.rule = input.second_order_in_time ? second_order(input.dt_s) : backward_euler(input.dt_s);
  load.gravity_m_s2 = limb.gravity_m_s2;
  limb.spring_force_N.assign(limb.springs.size(), Vec3::Zero());
  limb.spring_compliance_m_N.assign(limb.springs.size(), Mat3::Zero());
  follow_angles(limb);
  follow_touches(limb, workers);  // from where the limb is: from where it may go, nodes at a rim would swing for ever
  if (input.second_order_in_time) {
    carry_on(limb, kCarriedOn * input.dt_s);
    follow_angles(limb);
    see_neighbours(limb);
  }
  evaluate_lines(limb, load.rule);
  evaluate_sleepers(limb, load.rule);
  for (LimbMuscle& muscle : limb.muscles) {
    muscle.balanced = muscle.strained = false;
    if (!input.second_order_in_time) muscle.kept_rule.reset();
  }
  StepReport report;
  for (report.iterations = 1; report.iterations <= kMostIterations; ++report.iterations) {
    const Iteration iteration = newton_step(limb, {load}, workers, report.definite_solves);
    report.residual_share = iteration.residual_share;
    report.sound = iteration.sound;
    if (!iteration.sound) return report;
    const bool solved = iteration.residual_share < kSolvedShare && iteration.lines_share < kLinesSolvedShare;
    if (solved && iteration.rotation_rad < kLargestRotation_rad) break;
  }
  for (LimbMuscle& muscle : limb.muscles) {
    if (muscle.strained || muscle.residual_share > kKeptShare) muscle.kept_rule.reset();
  }
  report.sound = report.residual_share < 1.0;
  finish(limb, load.rule);
  return report;
}

Relaxation relax(Limb& limb, const RelaxInput& input, WorkerPool& workers) {
  TissueLoad load;
  load.rule = backward_euler(input.time_s);
  load.force_velocity = false;
  load.gravity_m_s2 = limb.gravity_m_s2;
  for (LimbMuscle& muscle : limb.muscles) {
    muscle.balanced = false;
    muscle.definite_tangents = 0;
    muscle.kept_rule.reset();
    muscle.state.last.position_m = muscle.state.now.position_m;
    muscle.state.last.velocity_m_s.setZero();
  }
  int definite_solves = 0;
  const Task task{load, Joints::Held, kRelaxedPart * input.share, input.farthest_m};
  const Iteration iteration = newton_step(limb, task, workers, definite_solves);
  return {iteration.sound, iteration.part};
}

void push_history(Limb& limb) {
  limb.before = limb.last;
  limb.last = limb.now;
  for (LimbMuscle& muscle : limb.muscles) {
    if (muscle.sleep) continue;  // all instants are the same
    std::swap(muscle.state.before, muscle.state.last);
    muscle.state.last = muscle.state.now;
    if (muscle.line) push_history(*muscle.line);
  }
}

void restore_last(Limb& limb) {
  limb.now = limb.last;
  for (LimbMuscle& muscle : limb.muscles) {
    muscle.state.now = muscle.state.last;
    if (muscle.line) restore_last(*muscle.line);
  }
  follow_angles(limb);
}

}  // namespace myotact::simulation
