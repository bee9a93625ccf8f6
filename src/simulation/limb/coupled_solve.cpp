#include "simulation/limb/coupled_solve.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"

namespace myotact::simulation {
namespace {

/// Of a Newton step.
constexpr int kMostStepIterations = 30;
/// The stiffness is read out of this solution itself.
constexpr double kFollowShare = 1e-7;
constexpr int kMostFollowIterations = 300;

using Columns = std::vector<Eigen::MatrixXd>;  // one a muscle, one row a free coordinate

double dot(const Columns& a, const Columns& b) {
  double sum = 0.0;
  for (std::size_t m = 0; m < a.size(); ++m) sum += a[m].cwiseProduct(b[m]).sum();
  return sum;
}

void add(double factor, const Columns& from, Columns& to) {
  for (std::size_t m = 0; m < from.size(); ++m) to[m] += factor * from[m];
}

/// to = from + factor to.
void update_direction(const Columns& from, double factor, Columns& to) {
  for (std::size_t m = 0; m < from.size(); ++m) to[m] = from[m] + factor * to[m];
}

Columns zeros(const Limb& limb, Eigen::Index columns) {
  Columns out;
  for (const LimbMuscle& muscle : limb.muscles) {
    out.push_back(Eigen::MatrixXd::Zero(is_solved(muscle) ? muscle.system.residual_N.size() : 0, columns));
  }
  return out;
}

/// Both sides have computed the slope, perhaps not in the same Newton step; the mean of this kind keeps the whole
/// positive.
Mat3 shared_slope(const NeighbourTouch& touch, const NeighbourTouch& theirs) {
  return touch_slope(touch, std::sqrt(touch.slope_N_m * theirs.slope_N_m));
}

/// The rows of one muscle of the coupling blocks times what its neighbours' columns hold. `columns_of(muscle)`: one row
/// a free coordinate, or empty.
template <class ColumnsOf>
void add_coupling(const Limb& limb, const LimbMuscle& muscle, const ColumnsOf& columns_of, Eigen::MatrixXd& out) {
  for (const NeighbourTouch& touch : muscle.state.touches) {
    const LimbMuscle& other = limb.muscles[at(touch.neighbour)];
    const NeighbourTouch& theirs = other.state.touches[at(touch.counterpart)];
    const Eigen::MatrixXd& columns = columns_of(touch.neighbour);
    if (touch.slope_N_m == 0.0 || theirs.slope_N_m == 0.0 || columns.size() == 0) continue;
    Eigen::Matrix3Xd gap = Eigen::Matrix3Xd::Zero(3, out.cols());
    for (std::size_t k = 0; k < at(theirs.count); ++k) {
      const int row = other.tissue.free_index[at(theirs.nodes[k])];
      if (row >= 0) gap += theirs.weights[k] * columns.middleRows<3>(3 * row);
    }
    const Eigen::Matrix3Xd pull = shared_slope(touch, theirs) * gap;
    for (std::size_t k = 0; k < at(touch.count); ++k) {
      const int row = muscle.tissue.free_index[at(touch.nodes[k])];
      if (row >= 0) out.middleRows<3>(3 * row) += touch.weights[k] * pull;
    }
  }
}

/// Of one muscle from columns of all.
void add_coupling_of(const Limb& limb, int muscle, const Columns& columns, Eigen::MatrixXd& out) {
  add_coupling(
      limb, limb.muscles[at(muscle)], [&](int m) -> const Eigen::MatrixXd& { return columns[at(m)]; }, out);
}

/// A step's unknowns beside the nodes'.
struct WholeStep {
  Limb& limb;
  const Eigen::PartialPivLU<Eigen::MatrixXd>& small;
  WorkerPool& workers;

  /// The arrow system without coupling, solved for forces on the nodes alone.
  Eigen::VectorXd solve_uncoupled(const Columns& force, Columns& nodes) const {
    workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
      if (is_solved(limb.muscles[at(m)])) nodes[at(m)] = solve(limb.muscles[at(m)], force[at(m)]);
    });
    const Eigen::Index rows = small.matrixLU().rows();
    if (rows == 0) return Eigen::VectorXd(0);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rows);
    for (std::size_t m = 0; m < nodes.size(); ++m) {
      const LimbMuscle& muscle = limb.muscles[m];
      if (is_solved(muscle)) right(muscle.unknowns) -= muscle.borders.transpose() * nodes[m].col(0);
    }
    Eigen::VectorXd rest = small.solve(right);
    for (std::size_t m = 0; m < nodes.size(); ++m) {
      const LimbMuscle& muscle = limb.muscles[m];
      if (is_solved(muscle)) nodes[m].col(0) -= muscle.border_solution * rest(muscle.unknowns);
    }
    return rest;
  }
};

void add_all_coupling(const Limb& limb, const Columns& columns, Columns& out) {
  for (int m = 0; m < static_cast<int>(limb.muscles.size()); ++m) {
    if (is_solved(limb.muscles[at(m)])) add_coupling_of(limb, m, columns, out[at(m)]);
  }
}

/// What the equations leave is small beside each muscle's forces.
bool small_enough(const Limb& limb, const Columns& residual, double share) {
  for (std::size_t m = 0; m < residual.size(); ++m) {
    if (residual[m].norm() > share * limb.muscles[m].system.force_scale_N) return false;
  }
  return true;
}

/// The static equations of all muscles, joints held.
struct StaticSystem {
  Limb& limb;
  WorkerPool& workers;

  void multiply(const Columns& from, Columns& to) const {
    workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
      const LimbMuscle& muscle = limb.muscles[at(m)];
      if (!is_solved(muscle)) return;
      const MeanTerm& mean = muscle.system.mean;
      to[at(m)] = muscle.system.matrix.lower().selfadjointView<Eigen::Lower>() * from[at(m)];
      to[at(m)] += mean.factor_Nm * mean.gradient * (mean.gradient.transpose() * from[at(m)]);
      add_coupling_of(limb, m, from, to[at(m)]);
    });
  }
  void solve_uncoupled(const Columns& force, Columns& nodes) const {
    workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
      if (is_solved(limb.muscles[at(m)])) nodes[at(m)] = solve(limb.muscles[at(m)], force[at(m)]);
    });
  }
};

/// One joint's column of couple_follow(), from the one without coupling.
bool follow_joint(const StaticSystem& system, int joint) {
  Columns follow = zeros(system.limb, 1), residual = follow, nodes = follow, product = follow;
  for (std::size_t m = 0; m < follow.size(); ++m) {
    if (!is_solved(system.limb.muscles[m])) continue;
    follow[m] = system.limb.muscles[m].follow_m_rad.col(joint);
    residual[m] = system.limb.muscles[m].system.coupling_N_rad.col(joint);
  }
  const double enough = kFollowShare * std::sqrt(dot(residual, residual));
  system.multiply(follow, product);
  add(-1.0, product, residual);
  system.solve_uncoupled(residual, nodes);
  Columns along = nodes;
  double weight = dot(residual, nodes);
  for (int i = 0; i < kMostFollowIterations && std::sqrt(dot(residual, residual)) > enough; ++i) {
    system.multiply(along, product);
    const double curvature = dot(along, product);
    if (curvature == 0.0 || !std::isfinite(curvature)) return false;
    add(weight / curvature, along, follow);
    add(-weight / curvature, product, residual);
    system.solve_uncoupled(residual, nodes);
    const double next = dot(residual, nodes);
    update_direction(nodes, next / weight, along);
    weight = next;
  }
  for (std::size_t m = 0; m < follow.size(); ++m) {
    if (is_solved(system.limb.muscles[m])) system.limb.muscles[m].follow_m_rad.col(joint) = follow[m];
  }
  return std::sqrt(dot(residual, residual)) <= enough;
}

}  // namespace

bool touches_neighbours(const Limb& limb) {
  return std::any_of(limb.muscles.begin(), limb.muscles.end(), [](const LimbMuscle& muscle) {
    return std::any_of(muscle.state.touches.begin(), muscle.state.touches.end(),
                       [](const NeighbourTouch& touch) { return touch.slope_N_m > 0.0; });
  });
}

void subtract_followed_coupling(const Limb& limb, const LimbMuscle& muscle, Eigen::MatrixXd& right) {
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(right.rows(), right.cols());
  add_coupling(
      limb, muscle, [&](int m) -> const Eigen::MatrixXd& { return limb.muscles[at(m)].follow_m_rad; }, product);
  right -= product;
}

void couple_step(Limb& limb, const Eigen::PartialPivLU<Eigen::MatrixXd>& small, double share, Eigen::VectorXd& solution,
                 WorkerPool& workers) {
  const bool coupled = touches_neighbours(limb);
  for (LimbMuscle& muscle : limb.muscles) muscle.coupled_m.resize(0);
  if (!coupled) return;
  Columns start = zeros(limb, 1), residual = start, change = start, nodes = start, along = start;
  for (std::size_t m = 0; m < start.size(); ++m) {
    const LimbMuscle& muscle = limb.muscles[m];
    if (is_solved(muscle)) start[m].col(0) = -muscle.free_solution - muscle.border_solution * solution(muscle.unknowns);
  }
  add_all_coupling(limb, start, residual);
  for (Eigen::MatrixXd& r : residual) r = -r;
  if (small_enough(limb, residual, share)) return;
  const WholeStep whole{limb, small, workers};
  Eigen::VectorXd rest = whole.solve_uncoupled(residual, nodes), along_rest = rest;
  along = nodes;
  Columns pushed = residual;  // uncoupled system times `along`
  double weight = dot(residual, nodes);
  for (int i = 0; i < kMostStepIterations; ++i) {
    Columns product = pushed;
    add_all_coupling(limb, along, product);
    const double curvature = dot(along, product);
    if (!(curvature > 0.0)) break;
    const double part = weight / curvature;
    add(part, along, change);
    solution += part * along_rest;
    add(-part, product, residual);
    if (small_enough(limb, residual, share)) break;
    rest = whole.solve_uncoupled(residual, nodes);
    const double next = dot(residual, nodes), kept = next / weight;
    weight = next;
    update_direction(nodes, kept, along);
    update_direction(residual, kept, pushed);
    along_rest = rest + kept * along_rest;
  }
  for (std::size_t m = 0; m < change.size(); ++m) limb.muscles[m].coupled_m = change[m].col(0);
}

bool couple_follow(Limb& limb, WorkerPool& workers) {
  if (!touches_neighbours(limb)) return true;
  bool solved = true;
  for (int j = 0; j < limb.skeleton.joint_count(); ++j) solved &= follow_joint({limb, workers}, j);
  return solved;
}

}  // namespace myotact::simulation
