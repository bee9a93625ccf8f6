#include "simulation/settle.h"

#include <algorithm>
#include <cmath>

namespace myotact::simulation {
namespace {

/// Angles are changed in parts no larger than this, so that the carried-along guess stays near the solution: 5 degrees.
constexpr double kLargestPart_rad = 0.0873;
/// Out-of-balance share at which a muscle rests, at the end and between two parts of an angle.
constexpr double kRestShare = 1e-9;
constexpr double kRoughShare = 1e-3;
constexpr int kMostIterations = 200;
/// Mass over (time constant)^2 is what damps the first iterations: at 2 ms an element's inertia equals its stiffness.
constexpr double kFirstTime_s = 2e-3;
constexpr double kShortestTime_s = 1e-6;
/// Beyond this the damping is far below the stiffness and the iteration is Newton's.
constexpr double kLongestTime_s = 1e3;
constexpr double kTimeGrowth = 3.0;
constexpr double kTimeCut = 0.2;
/// A guess that folds elements over farther than this is taken back.
constexpr double kSmallestJ = -0.5;

/// Share of the static residual (no inertia) in the size of the forces.
double rest_share(const Limb& limb, LimbMuscle& muscle) {
  TissueLoad load;
  load.gravity_m_s2 = limb.gravity_m_s2;
  compute_forces(muscle.tissue, limb.skeleton, load, muscle.state, muscle.system);
  return muscle.system.residual_N.norm() / (muscle.system.force_scale_N + 1e-6);
}

/// One damped Newton step from the present state. False when it cannot be solved.
bool damped_step(const Limb& limb, double time_s, LimbMuscle& muscle) {
  muscle.state.last.position_m = muscle.state.now.position_m;
  TissueLoad load;
  load.rule = backward_euler(time_s);
  load.force_velocity = false;
  load.gravity_m_s2 = limb.gravity_m_s2;
  compute_system(muscle.tissue, limb.skeleton, load, muscle.state, muscle.system);
  if (!factor_definite(muscle)) {
    load.definite = true;
    compute_system(muscle.tissue, limb.skeleton, load, muscle.state, muscle.system);
    if (!factor_definite(muscle)) return false;
  }
  const Eigen::VectorXd change = muscle.factor.solve(muscle.system.residual_N);
  if (!change.allFinite()) return false;
  for (std::size_t node = 0; node < muscle.tissue.body.size(); ++node) {
    const int f = muscle.tissue.free_index[node];
    if (f >= 0) muscle.state.now.position_m.segment<3>(static_cast<Eigen::Index>(3 * node)) -= change.segment<3>(3 * f);
  }
  return true;
}

/// Pseudo-time iteration: long steps while the residual falls, shorter ones when it does not.
bool settle_muscle(const Limb& limb, double wanted_share, LimbMuscle& muscle) {
  TissueState& state = muscle.state;
  state.last.velocity_m_s.setZero();
  std::fill(state.stretch_rate_1_s.begin(), state.stretch_rate_1_s.end(), 0.0);
  double share = rest_share(limb, muscle);
  double time_s = kFirstTime_s;
  for (int iteration = 0; iteration < kMostIterations && !(share < wanted_share); ++iteration) {
    const Eigen::VectorXd position = state.now.position_m;
    double next = damped_step(limb, time_s, muscle) ? rest_share(limb, muscle) : 1e300;
    // The residual may rise for a while as the damping is let go; a leap means that the guess left the solution's reach.
    const bool usable = std::isfinite(next) && next < std::max(3.0 * share, 0.1) && muscle.system.smallest_J > kSmallestJ;
    if (usable) {
      time_s = std::min(time_s * (next < share ? kTimeGrowth : 1.0), kLongestTime_s);
      share = next;
    } else {
      state.now.position_m = position;
      time_s *= kTimeCut;
      share = rest_share(limb, muscle);
      if (time_s < kShortestTime_s) break;
    }
  }
  return share < wanted_share;
}

/// Moves the free nodes with a smooth mix of the bodies' motions from `from` to the present pose.
void carry_along(const Limb& limb, const std::vector<Pose>& from, LimbMuscle& muscle) {
  const MuscleTissue& tissue = muscle.tissue;
  for (std::size_t node = 0; node < tissue.body.size(); ++node) {
    if (tissue.body[node] >= 0) continue;
    auto x = muscle.state.now.position_m.segment<3>(static_cast<Eigen::Index>(3 * node));
    Vec3 moved = Vec3::Zero();
    for (std::size_t k = 0; k < tissue.bodies.size(); ++k) {
      const std::size_t body = static_cast<std::size_t>(tissue.bodies[k]);
      const Pose motion = limb.skeleton.body_pose(tissue.bodies[k]) * from[body].inverse();
      moved += tissue.blend(static_cast<Eigen::Index>(node), static_cast<Eigen::Index>(k)) * (motion * Vec3(x));
    }
    x = moved;
  }
}

void turn_to(Limb& limb, const Eigen::VectorXd& angles_rad) {
  std::vector<Pose> from;
  for (int body = 0; body < limb.skeleton.body_count(); ++body) from.push_back(limb.skeleton.body_pose(body));
  limb.now.angle_rad = angles_rad;
  follow_angles(limb);
  for (LimbMuscle& muscle : limb.muscles) {
    if (!muscle.rigid) carry_along(limb, from, muscle);
  }
}

bool settle_all(Limb& limb, double wanted_share, WorkerPool& workers) {
  std::vector<char> settled(limb.muscles.size(), 1);
  workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
    const auto i = static_cast<std::size_t>(m);
    if (!limb.muscles[i].rigid) settled[i] = settle_muscle(limb, wanted_share, limb.muscles[i]);
  });
  return std::all_of(settled.begin(), settled.end(), [](char s) { return s != 0; });
}

/// All rates zero and all instants the same.
void bring_to_rest(Limb& limb) {
  limb.now.velocity_rad_s.setZero();
  limb.last = limb.before = limb.now;
  for (LimbMuscle& muscle : limb.muscles) {
    muscle.state.now.velocity_m_s.setZero();
    std::fill(muscle.state.stretch_rate_1_s.begin(), muscle.state.stretch_rate_1_s.end(), 0.0);
    muscle.state.last = muscle.state.before = muscle.state.now;
  }
  read_out(limb);
  limb.springs.clear();
  limb.spring_force_N.clear();
  limb.spring_compliance_m_N.clear();
}

}  // namespace

bool settle_limb(Limb& limb, std::span<const double> angles_rad, WorkerPool& workers) {
  const Eigen::VectorXd start = limb.now.angle_rad;
  const Eigen::VectorXd goal = Eigen::Map<const Eigen::VectorXd>(angles_rad.data(), start.size());
  const double way = start.size() > 0 ? (goal - start).cwiseAbs().maxCoeff() : 0.0;
  const int parts = std::max(1, static_cast<int>(std::ceil(way / kLargestPart_rad)));
  limb.skeleton.set_pose(limb.angles());
  bool settled = true;
  for (int part = 1; part <= parts; ++part) {
    turn_to(limb, start + (goal - start) * (static_cast<double>(part) / parts));
    settled = settle_all(limb, part == parts ? kRestShare : kRoughShare, workers);
  }
  bring_to_rest(limb);
  return settled;
}

void refresh_muscle_stiffness(const Limb& limb, LimbMuscle& muscle) {
  if (muscle.rigid) return;
  TissueLoad load;
  load.gravity_m_s2 = limb.gravity_m_s2;
  compute_system(muscle.tissue, limb.skeleton, load, muscle.state, muscle.system);
  if (!muscle.factor.factor(muscle.system.matrix)) return;
  const Eigen::MatrixXd solution = muscle.factor.solve(muscle.system.coupling_N_rad);
  const Eigen::MatrixXd whole =
      muscle.system.joint_stiffness_Nm_rad - muscle.system.coupling_N_rad.transpose() * solution;
  if (whole.allFinite()) muscle.stiffness_Nm_rad = whole.diagonal();
}

}  // namespace myotact::simulation
