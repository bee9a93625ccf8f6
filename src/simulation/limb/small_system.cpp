#include "simulation/limb/small_system.h"

#include <algorithm>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/at.h"

namespace myotact::simulation {
namespace {

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
    if (spring.muscle != index || spring.open) continue;
    used = small.spring_row(s) + 3;
    for (std::size_t k = 0; k < at(spring.point.count); ++k) {
      const int f = muscle.tissue.free_index[at(spring.point.nodes[k])];
      if (f < 0) continue;
      for (int i = 0; i < 3; ++i) muscle.borders(3 * f + i, small.spring_row(s) + i) = -spring.point.weights[k];
    }
  }
  return used;
}

/// What a muscle is solved for: its residual, then the borders that differ from zero.
Eigen::MatrixXd right_sides(const Limb& limb, const SmallSystem& small, int index, LimbMuscle& muscle) {
  const Eigen::Index used = fill_borders(limb, small, index, muscle);
  Eigen::MatrixXd sides(muscle.borders.rows(), 1 + used);
  sides << muscle.system.residual_N, muscle.borders.leftCols(used);
  return sides;
}

void take_solution(const Eigen::MatrixXd& solution, LimbMuscle& muscle) {
  muscle.free_solution = solution.col(0);
  muscle.border_solution.setZero(muscle.borders.rows(), muscle.borders.cols());
  muscle.border_solution.leftCols(solution.cols() - 1) = solution.rightCols(solution.cols() - 1);
  muscle.reduced.noalias() = muscle.borders.transpose() * muscle.border_solution;
}

/// Tangent, factor, and the solutions for the residual and the borders.
Pivots factor_muscle(const Limb& limb, const SmallSystem& small, const TissueLoad& load, int index,
                     LimbMuscle& muscle) {
  compute_system(limb.skeleton, load, muscle);
  Eigen::MatrixXd solution;
  const Pivots pivots = factor_system(muscle, right_sides(limb, small, index, muscle), solution);
  if (pivots == Pivots::Unusable) return pivots;
  take_solution(solution, muscle);
  muscle.kept_rule = load.rule;
  return pivots;
}

/// The same solutions with the factor of an earlier step: only the forces and the springs are new.
void solve_with_kept(const Limb& limb, const SmallSystem& small, const TissueLoad& load, int index,
                     LimbMuscle& muscle) {
  compute_forces(muscle.tissue, limb.skeleton, load, muscle.state, muscle.system);
  take_solution(solve(muscle, right_sides(limb, small, index, muscle)), muscle);
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

/// An open spring's force is zero, whatever the rest does.
void take_out(Eigen::Index row, SmallSystem& small) {
  small.matrix.middleRows<3>(row).setZero();
  small.matrix.middleCols<3>(row).setZero();
  small.matrix.block<3, 3>(row, row).diagonal().array() = -1.0;
  small.right.segment<3>(row).setZero();
}

/// The springs' forces f are unknowns: -(U^T du + J dq + f / k) = -(target - point), symmetric with the rest. Those of
/// one sphere share the coupling, so that all their forces stretch it, and have seats of their own.
void add_springs(const Limb& limb, SmallSystem& small) {
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    const ToolSpring& spring = limb.springs[s];
    const Eigen::Index row = small.spring_row(s);
    if (spring.open) continue;
    small.matrix.block<3, 3>(row, row).diagonal().array() -= 1.0 / spring.stiffness_N_m + seat_m_N(limb, spring);
    for (std::size_t t = 0; t < limb.springs.size(); ++t) {
      if (t == s || limb.springs[t].open || !of_one_sphere(spring, limb.springs[t])) continue;
      small.matrix.block<3, 3>(row, small.spring_row(t)).diagonal().array() -= 1.0 / spring.stiffness_N_m;
    }
    small.right.segment<3>(row) -= spring.target_W_m - spring_point(limb, spring);
    for (std::size_t a = 0; a < small.joints.size(); ++a) {
      const Vec3 slope = spring_slope(limb, spring, small.joints[a]);
      const auto column = static_cast<Eigen::Index>(a);
      small.matrix.block<3, 1>(row, column) -= slope;
      small.matrix.block<1, 3>(column, row) -= slope.transpose();
    }
  }
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    if (limb.springs[s].open) take_out(small.spring_row(s), small);
  }
}

/// The springs of the points that the sphere of a contact rests on.
std::vector<std::size_t> points_of_sphere(const Limb& limb, std::size_t contact) {
  std::vector<std::size_t> points;
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    if (!limb.springs[s].open && of_one_sphere(limb.springs[contact], limb.springs[s])) points.push_back(s);
  }
  return points;
}

/// Rows of all that may move while a sphere is pressed: joints and the springs of other tools.
std::vector<Eigen::Index> rows_beside(const Limb& limb, const SmallSystem& small, int tool) {
  std::vector<Eigen::Index> rows;
  for (std::size_t a = 0; a < small.joints.size(); ++a) rows.push_back(static_cast<Eigen::Index>(a));
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    if (limb.springs[s].tool == tool) continue;
    for (Eigen::Index k = 0; k < 3; ++k) rows.push_back(small.spring_row(s) + k);
  }
  return rows;
}

/// Compliance of a sphere that several points hold, its coupling left out: each point's own, its seat, and what joints
/// and other tools' springs add between them, in parallel. `own`: the sphere's springs, of the limb's.
Mat3 compliance_of_sphere(const Limb& limb, const SmallSystem& small, const std::vector<std::size_t>& own) {
  const std::vector<Eigen::Index> kept = rows_beside(limb, small, limb.springs[own.front()].tool);
  std::vector<Eigen::Index> rows;
  for (const std::size_t s : own) {
    for (Eigen::Index k = 0; k < 3; ++k) rows.push_back(small.spring_row(s) + k);
  }
  const Eigen::MatrixXd inner = small.matrix(kept, kept), border = small.matrix(kept, rows);
  // What the small system holds of the points themselves is minus their compliance and the coupling's and seats'.
  Eigen::MatrixXd points = -small.matrix(rows, rows);
  if (!kept.empty()) points += border.transpose() * inner.partialPivLu().solve(border);
  const double coupling_m_N = 1.0 / limb.springs[own.front()].stiffness_N_m;
  const Eigen::MatrixX3d all = Mat3::Identity().replicate(static_cast<Eigen::Index>(own.size()), 1);
  points -= coupling_m_N * all * all.transpose();
  return (all.transpose() * points.partialPivLu().solve(all)).inverse();
}

/// What the springs of the other tools take from a compliance: the joints and those springs' forces eliminated
/// together. `own`: the spring, of the limb's.
Mat3 compliance_beside(const Limb& limb, const SmallSystem& small, std::size_t own) {
  const std::vector<Eigen::Index> kept = rows_beside(limb, small, limb.springs[own].tool);
  const auto count = static_cast<Eigen::Index>(kept.size());
  Eigen::MatrixXd inner(count, count), border(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index row = kept[static_cast<std::size_t>(i)];
    border.row(i) = small.matrix.block<1, 3>(row, small.spring_row(own));
    for (Eigen::Index j = 0; j < count; ++j) inner(i, j) = small.matrix(row, kept[static_cast<std::size_t>(j)]);
  }
  return border.transpose() * inner.partialPivLu().solve(border);  // indefinite: the springs' block is negative
}

bool of_several_tools(const Limb& limb) {
  return std::any_of(limb.springs.begin(), limb.springs.end(),
                     [&](const ToolSpring& spring) { return spring.tool != limb.springs.front().tool; });
}

/// Compliance of what each spring pulls at, its tool's springs left out: U^T matrix^-1 U of its muscle, and what the
/// joints add, P^T joints^-1 P, which other tools that hold the limb or press on the same muscle lessen.
void read_compliance(Limb& limb, const SmallSystem& small) {
  const auto joints = static_cast<Eigen::Index>(small.joints.size());
  const Eigen::MatrixXd columns = small.matrix.topRightCorner(joints, small.size() - joints);
  const Eigen::MatrixXd rotations =
      joints > 0 && columns.cols() > 0
          ? Eigen::MatrixXd(small.matrix.topLeftCorner(joints, joints).ldlt().solve(columns))
          : columns;
  const bool several = of_several_tools(limb);
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    const int muscle = limb.springs[s].muscle;
    const auto first = static_cast<Eigen::Index>(3 * s);
    Mat3& compliance = limb.spring_compliance_m_N[s];
    compliance.setZero();
    if (limb.springs[s].open) continue;
    if (const std::vector<std::size_t> own = points_of_sphere(limb, s); own.size() > 1) {
      compliance = compliance_of_sphere(limb, small, own);
      continue;
    }
    if (muscle >= 0 && !limb.muscles[at(muscle)].rigid)
      compliance = limb.muscles[at(muscle)].reduced.block<3, 3>(small.spring_row(s), small.spring_row(s));
    if (several) {
      compliance += compliance_beside(limb, small, s);
    } else if (joints > 0) {
      compliance += columns.middleCols<3>(first).transpose() * rotations.middleCols<3>(first);
    }
  }
}

}  // namespace

SmallSystem make_small_system(const Limb& limb, Joints joints) {
  SmallSystem small;
  for (int j = 0; j < limb.skeleton.joint_count(); ++j) {
    if (joints == Joints::Free && limb.skeleton.moves(j)) small.joints.push_back(j);
  }
  const auto size = static_cast<Eigen::Index>(small.joints.size() + 3 * limb.springs.size());
  small.matrix = Eigen::MatrixXd::Zero(size, size);
  small.right = Eigen::VectorXd::Zero(size);
  return small;
}

void eliminate(const Limb& limb, const SmallSystem& small, TissueLoad load, int index, LimbMuscle& muscle) {
  if (muscle.balanced) {
    muscle.free_solution = solve(muscle, muscle.system.residual_N);
  } else if (muscle.kept_rule == load.rule) {
    solve_with_kept(limb, small, load, index, muscle);
  } else {
    muscle.made_definite = factor_muscle(limb, small, load, index, muscle) != Pivots::Positive;
    load.definite = true;
    muscle.sound = !muscle.made_definite || factor_muscle(limb, small, load, index, muscle) == Pivots::Positive;
    if (!muscle.sound) return;
  }
  muscle.reduced_residual.noalias() = muscle.borders.transpose() * muscle.free_solution;
  muscle.sound = muscle.free_solution.allFinite() && muscle.reduced.allFinite();
}

bool open_pulling(Limb& limb, const Eigen::VectorXd& solution, const SmallSystem& small) {
  std::optional<std::size_t> hardest;
  double hardest_N = 0.0;
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    const ToolSpring& spring = limb.springs[s];
    const double pull_N = solution.segment<3>(small.spring_row(s)).dot(spring.normal_W);
    if (spring.open || seat_m_N(limb, spring) == 0.0 || !(pull_N > hardest_N)) continue;
    hardest = s;
    hardest_N = pull_N;
  }
  if (!hardest) return false;
  limb.springs[*hardest].open = true;
  const int muscle = limb.springs[*hardest].muscle;
  if (muscle < 0 || limb.muscles[at(muscle)].rigid) return true;
  limb.muscles[at(muscle)].borders.middleCols<3>(small.spring_row(*hardest)).setZero();
  limb.muscles[at(muscle)].border_solution.middleCols<3>(small.spring_row(*hardest)).setZero();
  return true;
}

Eigen::VectorXd skeleton_residual(Limb& limb, const TimeRule& rule) {
  const Eigen::VectorXd velocity = joint_velocity_rad_s(limb, rule);
  const auto span = [](const Eigen::VectorXd& v) {
    return std::span<const double>(v.data(), static_cast<std::size_t>(v.size()));
  };
  limb.loads.compute(limb.skeleton, {limb.gravity_m_s2, span(velocity), span(limb.external_torque_Nm)});
  return limb.loads.mass_kg_m2 * joint_acceleration_rad_s2(limb, rule) - limb.loads.force_Nm;
}

void add_up(Limb& limb, const TimeRule& rule, SmallSystem& small) {
  small.matrix.setZero();
  small.right.setZero();
  add_skeleton(limb, rule, small);
  for (const LimbMuscle& muscle : limb.muscles) {
    if (muscle.line || muscle.sleep) add_joint_part(muscle, small);
    if (is_solved(muscle)) add_muscle(muscle, small);
  }
  add_springs(limb, small);
  read_compliance(limb, small);
}

}  // namespace myotact::simulation
