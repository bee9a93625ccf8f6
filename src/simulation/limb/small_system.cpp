#include "simulation/limb/small_system.h"

#include <algorithm>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/at.h"

namespace myotact::simulation {
namespace {

/// A muscle whose tangent was not positive definite gets safe ones for this many: slack tissue goes on buckling for
/// tenths of a second, and tangents that are true and safe by turns throw it to and fro. In the scripts of the scenes
/// `hindlimb`, `forelimb`, `stifle`, `hock` and `elbow` 40, 31, 23, 39 and 49 steps need more than two Newton steps, in
/// place of 79, 115, 63, 115 and 81 where the true one is tried every time. For ever, or from the start, would be as
/// fast; but safe tangents are stiff, and touch is told of them: 26 of the elbow's 42 places are good then, not 30.
constexpr int kDefiniteTangents = 50;

/// The unknowns that enter a muscle's equations, and the columns by which they do: of many hands' springs few pull at
/// it, and each column is one more solve.
void fill_borders(const Limb& limb, const SmallSystem& small, int index, LimbMuscle& muscle) {
  const auto joints = static_cast<Eigen::Index>(small.joints.size());
  muscle.unknowns.clear();
  for (Eigen::Index k = 0; k < joints; ++k) muscle.unknowns.push_back(k);
  std::vector<std::size_t> own;
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    if (limb.springs[s].muscle != index || limb.springs[s].open) continue;
    own.push_back(s);
    for (Eigen::Index i = 0; i < 3; ++i) muscle.unknowns.push_back(small.spring_row(s) + i);
  }
  muscle.borders.setZero(muscle.system.residual_N.size(), static_cast<Eigen::Index>(muscle.unknowns.size()));
  for (std::size_t k = 0; k < small.joints.size(); ++k) {
    muscle.borders.col(static_cast<Eigen::Index>(k)) = muscle.system.coupling_N_rad.col(small.joints[k]);
  }
  for (std::size_t o = 0; o < own.size(); ++o) {
    const MaterialPoint& point = limb.springs[own[o]].point;
    const Eigen::Index column = joints + 3 * static_cast<Eigen::Index>(o);
    for (std::size_t k = 0; k < at(point.count); ++k) {
      const int f = muscle.tissue.free_index[at(point.nodes[k])];
      if (f < 0) continue;
      for (int i = 0; i < 3; ++i) muscle.borders(3 * f + i, column + i) = -point.weights[k];
    }
  }
}

/// What a muscle is solved for: its residual, then its borders.
Eigen::MatrixXd right_sides(const Limb& limb, const SmallSystem& small, int index, LimbMuscle& muscle) {
  fill_borders(limb, small, index, muscle);
  Eigen::MatrixXd sides(muscle.borders.rows(), 1 + muscle.borders.cols());
  sides << muscle.system.residual_N, muscle.borders;
  return sides;
}

void take_solution(const Eigen::MatrixXd& solution, LimbMuscle& muscle) {
  muscle.free_solution = solution.col(0);
  muscle.border_solution = solution.rightCols(solution.cols() - 1);
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

/// A tangent that can be factored: the true one, or the safe one where that is not positive definite.
void factor_anew(const Limb& limb, const SmallSystem& small, TissueLoad load, int index, LimbMuscle& muscle) {
  if (muscle.definite_tangents == 0) {
    muscle.made_definite = factor_muscle(limb, small, load, index, muscle) != Pivots::Positive;
    muscle.sound = true;
    if (!muscle.made_definite) return;
    muscle.definite_tangents = kDefiniteTangents;
  }
  --muscle.definite_tangents;
  load.definite = muscle.made_definite = true;
  muscle.sound = factor_muscle(limb, small, load, index, muscle) == Pivots::Positive;
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
  small.matrix(muscle.unknowns, muscle.unknowns) -= muscle.reduced;
  small.right(muscle.unknowns) += muscle.reduced_residual;
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

/// Where an unknown of the small system stands among those of a muscle.
Eigen::Index place_of(Eigen::Index unknown, const LimbMuscle& muscle) {
  return std::lower_bound(muscle.unknowns.begin(), muscle.unknowns.end(), unknown) - muscle.unknowns.begin();
}

/// Of the muscle that a spring pulls at, everything else held. Zero for a bone or a shape.
Mat3 own_compliance(const Limb& limb, const SmallSystem& small, std::size_t spring) {
  const int muscle = limb.springs[spring].muscle;
  if (muscle < 0 || !is_solved(limb.muscles[at(muscle)])) return Mat3::Zero();
  const LimbMuscle& own = limb.muscles[at(muscle)];
  const Eigen::Index first = place_of(small.spring_row(spring), own);
  return own.reduced.block<3, 3>(first, first);
}

/// Inverse of the small system without the springs ahead, which hold nothing.
struct Bearing {
  std::vector<Eigen::Index> rows;    // of the small system
  std::vector<Eigen::Index> spring;  // first row in `inverse` of each spring of the limb's; -1: ahead
  Eigen::MatrixXd inverse;
};

Bearing make_bearing(const Limb& limb, const SmallSystem& small) {
  Bearing bearing;
  for (std::size_t a = 0; a < small.joints.size(); ++a) bearing.rows.push_back(static_cast<Eigen::Index>(a));
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    bearing.spring.push_back(limb.springs[s].ahead ? -1 : static_cast<Eigen::Index>(bearing.rows.size()));
    if (limb.springs[s].ahead) continue;
    for (Eigen::Index k = 0; k < 3; ++k) bearing.rows.push_back(small.spring_row(s) + k);
  }
  bearing.inverse = Eigen::MatrixXd(small.matrix(bearing.rows, bearing.rows)).inverse();
  return bearing;
}

/// Compliance between some springs of one tool (`own`, of the limb's, none ahead): their own and their seats included,
/// all else eliminated but the tool's other springs.
Eigen::MatrixXd compliance_between(const Limb& limb, const Bearing& bearing, const std::vector<std::size_t>& own) {
  std::vector<Eigen::Index> of_tool, wanted;
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    if (limb.springs[s].tool != limb.springs[own.front()].tool) continue;
    const bool is_wanted = std::find(own.begin(), own.end(), s) != own.end();
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (is_wanted) wanted.push_back(static_cast<Eigen::Index>(of_tool.size()));
      of_tool.push_back(bearing.spring[s] + k);
    }
  }
  const Eigen::MatrixXd left = Eigen::MatrixXd(bearing.inverse(of_tool, of_tool)).inverse();
  return -left(wanted, wanted);
}

/// Compliance of a sphere that several points hold, its coupling left out: each point's own, its seat, and what joints
/// and other tools' springs add between them, in parallel. `own`: the sphere's springs, of the limb's.
Mat3 compliance_of_sphere(const Limb& limb, const Bearing& bearing, const std::vector<std::size_t>& own) {
  Eigen::MatrixXd points = compliance_between(limb, bearing, own);
  const double coupling_m_N = 1.0 / limb.springs[own.front()].stiffness_N_m;
  const Eigen::MatrixX3d all = Mat3::Identity().replicate(static_cast<Eigen::Index>(own.size()), 1);
  points -= coupling_m_N * all * all.transpose();
  return (all.transpose() * points.partialPivLu().solve(all)).inverse();
}

/// What one spring pulls at, beside other tools that hold the limb or press on the same muscle.
Mat3 compliance_beside_tools(const Limb& limb, const SmallSystem& small, const Bearing& bearing, std::size_t own) {
  const ToolSpring& spring = limb.springs[own];
  const Mat3 alone = (1.0 / spring.stiffness_N_m + seat_m_N(limb, spring)) * Mat3::Identity();
  if (!spring.ahead) return Mat3(compliance_between(limb, bearing, {own})) - alone;
  const std::vector<Eigen::Index> rows = {small.spring_row(own), small.spring_row(own) + 1, small.spring_row(own) + 2};
  const Eigen::MatrixXd border = small.matrix(bearing.rows, rows);
  const Mat3 compliance = border.transpose() * bearing.inverse * border;
  return compliance + own_compliance(limb, small, own);
}

bool of_several_tools(const Limb& limb) {
  return std::any_of(limb.springs.begin(), limb.springs.end(),
                     [&](const ToolSpring& spring) { return spring.tool != limb.springs.front().tool; });
}

/// Of each spring alone: its muscle's, and what joints add.
void read_compliance_of_one_tool(Limb& limb, const SmallSystem& small) {
  const auto joints = static_cast<Eigen::Index>(small.joints.size());
  const Eigen::MatrixXd columns = small.matrix.topRightCorner(joints, small.size() - joints);
  const Eigen::MatrixXd rotations =
      joints > 0 && columns.cols() > 0
          ? Eigen::MatrixXd(small.matrix.topLeftCorner(joints, joints).ldlt().solve(columns))
          : columns;
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    if (limb.springs[s].open) continue;
    const auto first = static_cast<Eigen::Index>(3 * s);
    Mat3& compliance = limb.spring_compliance_m_N[s];
    compliance = own_compliance(limb, small, s);
    if (joints > 0) compliance += columns.middleCols<3>(first).transpose() * rotations.middleCols<3>(first);
  }
}

/// Compliance of what each spring pulls at, its tool's springs left out: U^T matrix^-1 U of its muscle, and what the
/// joints add, P^T joints^-1 P, which other tools that hold the limb or press on the same muscle lessen.
void read_compliance(Limb& limb, const SmallSystem& small) {
  const bool several = of_several_tools(limb);
  std::optional<Bearing> bearing;
  const auto borne = [&]() -> const Bearing& {
    if (!bearing) bearing = make_bearing(limb, small);
    return *bearing;
  };
  if (!several) read_compliance_of_one_tool(limb, small);
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    Mat3& compliance = limb.spring_compliance_m_N[s];
    if (limb.springs[s].open) {
      compliance.setZero();
    } else if (const std::vector<std::size_t> own = points_of_sphere(limb, s); own.size() > 1) {
      compliance = compliance_of_sphere(limb, borne(), own);
    } else if (several) {
      compliance = compliance_beside_tools(limb, small, borne(), s);
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
  if (muscle.balanced && muscle.borders_stale) {
    take_solution(solve(muscle, right_sides(limb, small, index, muscle)), muscle);
  } else if (muscle.balanced) {
    muscle.free_solution = solve(muscle, muscle.system.residual_N);
  } else if (muscle.kept_rule == load.rule) {
    solve_with_kept(limb, small, load, index, muscle);
  } else {
    factor_anew(limb, small, load, index, muscle);
    if (!muscle.sound) return;
  }
  muscle.borders_stale = false;
  muscle.reduced_residual.noalias() = muscle.borders.transpose() * muscle.free_solution;
  muscle.sound = muscle.free_solution.allFinite() && muscle.reduced.allFinite();
}

void close_springs(Limb& limb) {
  for (ToolSpring& spring : limb.springs) {
    if (!spring.open) continue;
    spring.open = false;
    if (spring.muscle >= 0) limb.muscles[at(spring.muscle)].borders_stale = true;
  }
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
  LimbMuscle& pulled = limb.muscles[at(muscle)];
  const Eigen::Index first = place_of(small.spring_row(*hardest), pulled);
  pulled.borders.middleCols<3>(first).setZero();
  pulled.border_solution.middleCols<3>(first).setZero();
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
