#include "simulation/step.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace myotact::simulation {
namespace {

/// Newton steps at most; the second one is needed only when a hand yanks or an activation jumps.
constexpr int kMostIterations = 3;
/// Out-of-balance force, over the size of the elements' forces, at which a step counts as solved. Below the 3 % that
/// one linearised step costs in force anyway (measured on twitches against steps of 1 ms).
constexpr double kSolvedShare = 0.02;
/// Out-of-balance torque of the joints, over the sum of the lines' torques, at which Line muscles count as solved: they
/// cost next to nothing, so that one more step of Newton's is worth a figure's fourth digit.
constexpr double kLinesSolvedShare = 1e-4;
/// A joint that turns farther than this in one Newton step is linearised once more [rad].
constexpr double kLargestTurn_rad = 0.05;
/// A place where an element folds over farther than this is not looked at.
constexpr double kSmallestJ = -0.5;
/// A Newton step ends where the energy rises by less than this part of how steeply it fell at the start.
constexpr double kSteepestRise = 0.5;
constexpr int kMostCuts = 5;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// The unknowns of the small system: angles of the joints that may turn, then 3 numbers a spring.
struct SmallSystem {
  std::vector<int> joints;
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;

  Eigen::Index size() const { return right.size(); }
  Eigen::Index spring_row(std::size_t spring) const { return static_cast<Eigen::Index>(joints.size() + 3 * spring); }
};

SmallSystem make_small_system(const Limb& limb) {
  SmallSystem small;
  for (int j = 0; j < limb.skeleton.joint_count(); ++j) {
    if (limb.skeleton.moves(j)) small.joints.push_back(j);
  }
  const auto size = static_cast<Eigen::Index>(small.joints.size() + 3 * limb.springs.size());
  small.matrix = Eigen::MatrixXd::Zero(size, size);
  small.right = Eigen::VectorXd::Zero(size);
  return small;
}

/// Columns by which the small unknowns enter a muscle's equations. Returns how many of them may differ from zero: the
/// springs' come last, and most muscles have none.
Eigen::Index fill_borders(const Limb& limb, const SmallSystem& small, int index, LimbMuscle& muscle) {
  muscle.borders.setZero(muscle.system.residual_N.size(), small.size());
  auto used = static_cast<Eigen::Index>(small.joints.size());
  for (std::size_t k = 0; k < small.joints.size(); ++k) {
    muscle.borders.col(static_cast<Eigen::Index>(k)) = muscle.system.coupling_N_rad.col(small.joints[k]);
  }
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    const ToolSpring& spring = limb.springs[s];
    if (spring.muscle != index) continue;
    used = small.spring_row(s) + 3;
    for (std::size_t k = 0; k < at(spring.point.count); ++k) {
      const int f = muscle.tissue.free_index[at(spring.point.nodes[k])];
      if (f < 0) continue;
      for (int i = 0; i < 3; ++i) muscle.borders(3 * f + i, small.spring_row(s) + i) = -spring.point.weights[k];
    }
  }
  return used;
}

/// Tangent, factor, and the solutions for the residual and the borders.
Pivots factor_muscle(const Limb& limb, const SmallSystem& small, const TissueLoad& load, int index,
                     LimbMuscle& muscle) {
  compute_system(limb.skeleton, load, muscle);
  const Eigen::Index used = fill_borders(limb, small, index, muscle);
  Eigen::MatrixXd sides(muscle.borders.rows(), 1 + used), solution;
  sides << muscle.system.residual_N, muscle.borders.leftCols(used);
  const Pivots pivots = factor_system(muscle, sides, solution);
  if (pivots == Pivots::Unusable) return pivots;
  muscle.free_solution = solution.col(0);
  muscle.border_solution.setZero(muscle.borders.rows(), muscle.borders.cols());
  muscle.border_solution.leftCols(used) = solution.rightCols(used);
  return pivots;
}

/// Tangent, factor, border solutions of one muscle. A muscle that the first Newton step has balanced keeps its tangent
/// in the later ones: only its residual is new. It is cheap, and the muscles that are out of balance set the pace.
void eliminate(const Limb& limb, const SmallSystem& small, TissueLoad load, int index, LimbMuscle& muscle) {
  if (muscle.balanced) {
    muscle.free_solution = solve(muscle, muscle.system.residual_N);
  } else {
    muscle.made_definite = factor_muscle(limb, small, load, index, muscle) != Pivots::Positive;
    load.definite = true;
    muscle.sound = !muscle.made_definite || factor_muscle(limb, small, load, index, muscle) == Pivots::Positive;
    if (!muscle.sound) return;
    muscle.reduced.noalias() = muscle.borders.transpose() * muscle.border_solution;
  }
  muscle.reduced_residual.noalias() = muscle.borders.transpose() * muscle.free_solution;
  muscle.sound = muscle.free_solution.allFinite() && muscle.reduced.allFinite();
}

/// Out-of-balance torque of the bones themselves at the present angles; fills limb.loads.
Eigen::VectorXd skeleton_residual(Limb& limb, const TimeRule& rule) {
  const Eigen::VectorXd& q = limb.now.angle_rad;
  const Eigen::VectorXd velocity =
      rule.rate_1_s * q - rule.now_1_s * limb.last.angle_rad + rule.before_1_s * limb.before.angle_rad;
  const Eigen::VectorXd acceleration =
      rule.rate_1_s * velocity - rule.now_1_s * limb.last.velocity_rad_s + rule.before_1_s * limb.before.velocity_rad_s;
  const auto span = [](const Eigen::VectorXd& v) {
    return std::span<const double>(v.data(), static_cast<std::size_t>(v.size()));
  };
  limb.loads.compute(limb.skeleton, {limb.gravity_m_s2, span(velocity), span(limb.external_torque_Nm)});
  return limb.loads.mass_kg_m2 * acceleration - limb.loads.force_Nm;
}

void add_skeleton(Limb& limb, const TimeRule& rule, SmallSystem& small) {
  const Eigen::VectorXd residual = skeleton_residual(limb, rule);
  Eigen::MatrixXd tangent = limb.loads.mass_kg_m2 * rule.rate_1_s * rule.rate_1_s + limb.loads.stiffness_Nm_rad;
  tangent.diagonal() += limb.loads.damping_Nms_rad * rule.rate_1_s;
  for (std::size_t a = 0; a < small.joints.size(); ++a) {
    const auto row = static_cast<Eigen::Index>(a);
    small.right[row] -= residual[small.joints[a]];
    for (std::size_t b = 0; b < small.joints.size(); ++b) {
      small.matrix(row, static_cast<Eigen::Index>(b)) += tangent(small.joints[a], small.joints[b]);
    }
  }
}

/// What a muscle's own pull on the joints adds to the small system.
void add_joint_part(const LimbMuscle& muscle, SmallSystem& small) {
  for (std::size_t a = 0; a < small.joints.size(); ++a) {
    const auto row = static_cast<Eigen::Index>(a);
    small.right[row] -= muscle.system.joint_residual_Nm[small.joints[a]];
    for (std::size_t b = 0; b < small.joints.size(); ++b) {
      small.matrix(row, static_cast<Eigen::Index>(b)) +=
          muscle.system.joint_stiffness_Nm_rad(small.joints[a], small.joints[b]);
    }
  }
}

/// What a muscle adds to the small system once its nodes are eliminated.
void add_muscle(const LimbMuscle& muscle, SmallSystem& small) {
  small.matrix -= muscle.reduced;
  small.right += muscle.reduced_residual;
  add_joint_part(muscle, small);
}

/// The springs' forces f are unknowns: -(U^T du + J dq + f / k) = -(target - point), symmetric with the rest.
void add_springs(const Limb& limb, SmallSystem& small) {
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    const ToolSpring& spring = limb.springs[s];
    const Eigen::Index row = small.spring_row(s);
    small.matrix.block<3, 3>(row, row).diagonal().array() -= 1.0 / spring.stiffness_N_m;
    small.right.segment<3>(row) -= spring.target_W_m - spring_point(limb, spring);
    for (std::size_t a = 0; a < small.joints.size(); ++a) {
      const Vec3 slope = spring_slope(limb, spring, small.joints[a]);
      const auto column = static_cast<Eigen::Index>(a);
      small.matrix.block<3, 1>(row, column) -= slope;
      small.matrix.block<1, 3>(column, row) -= slope.transpose();
    }
  }
}

/// Compliance of the tissue under each spring: U^T matrix^-1 U of the muscle alone.
void read_compliance(Limb& limb, const SmallSystem& small) {
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    const int muscle = limb.springs[s].muscle;
    const Eigen::Index row = small.spring_row(s);
    limb.spring_compliance_m_N[s].setZero();
    if (muscle < 0 || limb.muscles[at(muscle)].rigid) continue;
    limb.spring_compliance_m_N[s] = limb.muscles[at(muscle)].reduced.block<3, 3>(row, row);
  }
}

/// The Newton step from the instant where it was computed: start + part * change.
struct Way {
  Eigen::VectorXd start_rad, change_rad;  // joints; the nodes' are in the muscles
  const Eigen::VectorXd& solution;        // of the small system
};

/// How far a muscle is from balance, tool springs included, and the slope of its energy along the way.
void weigh(const Limb& limb, int index, LimbMuscle& muscle) {
  Eigen::VectorXd unbalanced = muscle.system.residual_N;
  for (const ToolSpring& spring : limb.springs) {
    if (spring.muscle != index) continue;
    const Vec3 force = spring.stiffness_N_m * (spring.target_W_m - spring_point(limb, spring));
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
void start_way(const Limb& limb, const Way& way, int index, LimbMuscle& muscle) {
  muscle.start_m = muscle.state.now.position_m;
  muscle.change_m = -muscle.free_solution;
  muscle.change_m.noalias() -= muscle.border_solution * way.solution;
  weigh(limb, index, muscle);
}

/// Moves a muscle's nodes along the way and computes its forces there.
void evaluate(const Limb& limb, const TissueLoad& load, double part, int index, LimbMuscle& muscle) {
  muscle.state.now.position_m = muscle.start_m;
  move_free_nodes(muscle, part * muscle.change_m);
  place_clamped(muscle.tissue, limb.skeleton, muscle.state);
  compute_forces(muscle.tissue, limb.skeleton, load, muscle.state, muscle.system);
  weigh(limb, index, muscle);
}

/// Slope of the step's energy along the way at the present place; what is done by springs through the joints included.
double energy_slope(Limb& limb, const TimeRule& rule, const Way& way) {
  double slope = skeleton_residual(limb, rule).dot(way.change_rad);
  for (const LimbMuscle& muscle : limb.muscles) {
    if (!muscle.rigid) slope += muscle.energy_slope;
    if (!muscle.rigid || muscle.line) slope += muscle.system.joint_residual_Nm.dot(way.change_rad);
  }
  for (const ToolSpring& spring : limb.springs) {
    const Vec3 force = spring.stiffness_N_m * (spring.target_W_m - spring_point(limb, spring));
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
  workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
    if (!limb.muscles[at(m)].rigid) evaluate(limb, load, part, m, limb.muscles[at(m)]);
  });
  return std::all_of(limb.muscles.begin(), limb.muscles.end(), [](const LimbMuscle& m) { return m.rigid || m.sound; });
}

/// The way that the small system's solution means; all muscles' start and change.
Way make_way(Limb& limb, const SmallSystem& small, const Eigen::VectorXd& solution, WorkerPool& workers) {
  Way way{limb.now.angle_rad, Eigen::VectorXd::Zero(limb.skeleton.joint_count()), solution};
  for (std::size_t a = 0; a < small.joints.size(); ++a) {
    way.change_rad[small.joints[a]] = solution[static_cast<Eigen::Index>(a)];
  }
  workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
    if (!limb.muscles[at(m)].rigid) start_way(limb, way, m, limb.muscles[at(m)]);
  });
  return way;
}

/// Goes the whole way unless the energy has turned to rise steeply by then; then back towards the lowest place on it.
bool search_way(Limb& limb, const TissueLoad& load, const Way& way, WorkerPool& workers) {
  const double start_slope = energy_slope(limb, load.rule, way);
  double part = 1.0;
  for (int cut = 0; cut < kMostCuts; ++cut) {
    const bool sound = go(limb, load, way, part, workers);
    const double slope = sound ? energy_slope(limb, load.rule, way) : 0.0;
    if (sound && (start_slope >= 0.0 || slope < kSteepestRise * -start_slope)) return true;
    part *= sound ? std::clamp(start_slope / (start_slope - slope), 0.1, 0.7) : 0.3;
  }
  return go(limb, load, way, part, workers);
}

struct Iteration {
  bool sound = true;
  double residual_share = 0.0;
  double lines_share = 0.0;  // of the joints' balance, where only lines and bones have a part in it
  double turn_rad = 0.0;
};

/// Out-of-balance torque of the joints that may turn over the sizes of the lines' torques; 0 where finite elements or
/// springs have a part in the balance, which the muscles' own residuals then tell.
double lines_share(Limb& limb, const TimeRule& rule) {
  double scale_Nm = 0.0;
  for (const LimbMuscle& muscle : limb.muscles) {
    if (!muscle.rigid) return 0.0;
    if (muscle.line) scale_Nm += muscle.system.joint_residual_Nm.cwiseAbs().maxCoeff();
  }
  if (scale_Nm == 0.0 || !limb.springs.empty()) return 0.0;
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

Iteration newton_step(Limb& limb, const TissueLoad& load, WorkerPool& workers, int& definite_solves) {
  SmallSystem small = make_small_system(limb);
  workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
    if (!limb.muscles[at(m)].rigid) eliminate(limb, small, load, m, limb.muscles[at(m)]);
  });
  add_skeleton(limb, load.rule, small);
  for (const LimbMuscle& muscle : limb.muscles) {
    if (muscle.line) add_joint_part(muscle, small);
    if (muscle.rigid) continue;
    if (!muscle.sound) return {false};
    definite_solves += muscle.made_definite;
    add_muscle(muscle, small);
  }
  add_springs(limb, small);
  read_compliance(limb, small);
  const Eigen::VectorXd solution =
      small.size() > 0 ? Eigen::VectorXd(small.matrix.partialPivLu().solve(small.right)) : small.right;
  if (!solution.allFinite()) return {false};

  const Way way = make_way(limb, small, solution, workers);
  Iteration result;
  result.sound = search_way(limb, load, way, workers);
  result.lines_share = lines_share(limb, load.rule);
  if (way.change_rad.size() > 0) result.turn_rad = way.change_rad.cwiseAbs().maxCoeff();
  for (LimbMuscle& muscle : limb.muscles) {
    if (muscle.rigid) continue;
    result.residual_share = std::max(result.residual_share, muscle.residual_share);
    muscle.balanced = muscle.residual_share < kSolvedShare;
  }
  return result;
}

/// Rates that the next step starts from.
void finish(Limb& limb, const TimeRule& rule) {
  limb.now.velocity_rad_s =
      rule.rate_1_s * limb.now.angle_rad - rule.now_1_s * limb.last.angle_rad + rule.before_1_s * limb.before.angle_rad;
  for (LimbMuscle& muscle : limb.muscles) {
    TissueState& state = muscle.state;
    for (std::size_t p = 0; p < state.stretch_rate_1_s.size(); ++p) {
      state.stretch_rate_1_s[p] =
          rule.rate_1_s * state.now.stretch[p] - rule.history(state.last.stretch[p], state.before.stretch[p]);
    }
  }
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    const ToolSpring& spring = limb.springs[s];
    limb.spring_force_N[s] = spring.stiffness_N_m * (spring.target_W_m - spring_point(limb, spring));
  }
  read_out(limb);
}

}  // namespace

StepReport advance(Limb& limb, const StepInput& input, WorkerPool& workers) {
  TissueLoad load;
  load.rule = input.second_order_in_time ? second_order(input.dt_s) : backward_euler(input.dt_s);
  load.gravity_m_s2 = limb.gravity_m_s2;
  limb.spring_force_N.assign(limb.springs.size(), Vec3::Zero());
  limb.spring_compliance_m_N.assign(limb.springs.size(), Mat3::Zero());
  follow_angles(limb);
  evaluate_lines(limb, load.rule);
  for (LimbMuscle& muscle : limb.muscles) muscle.balanced = false;
  StepReport report;
  for (report.iterations = 1; report.iterations <= kMostIterations; ++report.iterations) {
    const Iteration iteration = newton_step(limb, load, workers, report.definite_solves);
    report.residual_share = iteration.residual_share;
    report.sound = iteration.sound;
    if (!iteration.sound) return report;
    const bool solved = iteration.residual_share < kSolvedShare && iteration.lines_share < kLinesSolvedShare;
    if (solved && iteration.turn_rad < kLargestTurn_rad) break;
  }
  report.sound = report.residual_share < 1.0;
  finish(limb, load.rule);
  return report;
}

void push_history(Limb& limb) {
  limb.before = limb.last;
  limb.last = limb.now;
  for (LimbMuscle& muscle : limb.muscles) {
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
