#include "simulation/limb/settle.h"

#include <algorithm>
#include <cmath>

#include "simulation/limb/coupled_solve.h"
#include "simulation/limb/find_touches.h"
#include "simulation/limb/settle_together.h"
#include "simulation/limb/sleep.h"

namespace myotact::simulation {
namespace {

/// Angles are changed in parts no larger than this, so that the carried-along guess stays near the solution: 5 degrees.
constexpr double kLargestPart_rad = 0.0873;
/// Activations of muscles that touch are changed in parts no larger than this: bellies that thicken at once find
/// themselves within one another.
constexpr double kLargestActivationPart = 0.1;
/// Out-of-balance share at which a muscle rests, at the end and between two parts of an angle.
constexpr double kRestShare = 1e-9;
constexpr double kRoughShare = 1e-3;
/// A slack thin muscle that buckles wanders for about 100, the forelimb's acromial deltoid for 300 to 1600, by the
/// processor's rounding (measured); the others rest after 10 to 40.
constexpr int kMostIterations = 2500;
/// Time constant of a muscle's first step.
constexpr double kFirstTime_s = 2e-3;
/// A step ends where the forces along it have fallen to this part of what they were, or still point onwards.
constexpr double kLineSearchDrop = 0.5;
constexpr int kMostCuts = 12;
/// Where a whole step leaves the forces along it almost as they were, the safe tangent is far too stiff (a slack muscle
/// that unbuckles creeps for hundreds of steps): the step is doubled as long as that holds.
constexpr double kStillSteep = 0.8;
constexpr double kLongestStep = 1024.0;
/// No node goes farther in one step: where tissue buckles on a bone, a nearly singular tangent asks for hundreds of
/// millimetres, and the muscle would end beyond the bone (biceps femoris at the greater trochanter did).
constexpr double kFarthestMove_m = 20e-3;
/// A guess that folds elements over farther than this is not looked at.
constexpr double kSmallestJ = -0.5;

/// Newton direction of the tangent with its inertia term, shortened to what a node may move at once; false when not
/// even the safe one can be factored.
bool find_direction(const Skeleton& skeleton, TissueLoad load, double time_s, LimbMuscle& muscle,
                    Eigen::MatrixXd& direction) {
  muscle.state.last.position_m = muscle.state.now.position_m;
  load.rule = backward_euler(time_s);
  load.force_velocity = false;
  compute_system(skeleton, load, muscle);
  Pivots pivots = factor_system(muscle, -muscle.system.residual_N, direction);
  if (pivots != Pivots::Positive) {
    load.definite = true;
    compute_system(skeleton, load, muscle);
    pivots = factor_system(muscle, -muscle.system.residual_N, direction);
  }
  if (pivots != Pivots::Positive || !direction.allFinite()) return false;
  const double farthest_m = direction.lpNorm<Eigen::Infinity>();
  if (farthest_m > kFarthestMove_m) direction *= kFarthestMove_m / farthest_m;
  return true;
}

/// What lies at a part of `direction` from `start`: the force along it (> 0: the energy still falls) and whether the
/// place can be looked at.
struct Outlook {
  double force = 0.0;
  bool seen = false;
};

/// Goes along `direction` as far as the energy falls: every force has a potential in a static solve, and its slope
/// along the way is residual . direction, so the slope alone determines where to stop. Returns the part gone, 0 when
/// none helps.
double search_line(const Skeleton& skeleton, const TissueLoad& load, const Eigen::VectorXd& direction,
                   LimbMuscle& muscle) {
  const double slope = -muscle.system.residual_N.dot(direction);
  const Eigen::VectorXd start = muscle.state.now.position_m;
  const auto at = [&](double part) {
    muscle.state.now.position_m = start;
    move_free_nodes(muscle, part * direction);
    compute_forces(muscle.tissue, skeleton, load, muscle.state, muscle.system);
    const double force = -muscle.system.residual_N.dot(direction);
    return Outlook{force, std::isfinite(force) && muscle.system.smallest_J > kSmallestJ};
  };
  const auto go_on = [&](double part) {
    while (part < kLongestStep) {
      const Outlook there = at(2.0 * part);
      if (!there.seen || there.force < 0.0) break;
      part *= 2.0;
      if (there.force < kStillSteep * slope) return part;
    }
    at(part);
    return part;
  };
  double part = 1.0;
  for (int cut = 0; cut < kMostCuts; ++cut) {
    const Outlook there = at(part);
    if (there.seen && there.force > -kLineSearchDrop * slope) {
      return there.force > kStillSteep * slope && part == 1.0 ? go_on(part) : part;
    }
    part *= there.seen ? std::clamp(slope / (slope - there.force), 0.1, 0.7) : 0.3;
  }
  at(0.0);
  return 0.0;
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
    if (is_solved(muscle)) carry_along(limb, from, muscle);
  }
}

Eigen::VectorXd activations_of(const Limb& limb) {
  Eigen::VectorXd activations(static_cast<Eigen::Index>(limb.muscles.size()));
  for (std::size_t m = 0; m < limb.muscles.size(); ++m) {
    activations[static_cast<Eigen::Index>(m)] = limb.muscles[m].state.activation;
  }
  return activations;
}

void activate(Limb& limb, const Eigen::VectorXd& activations) {
  for (std::size_t m = 0; m < limb.muscles.size(); ++m) {
    limb.muscles[m].state.activation = activations[static_cast<Eigen::Index>(m)];
  }
}

int parts_of(const Eigen::VectorXd& change, double largest_part) {
  return change.size() > 0 ? static_cast<int>(std::ceil(change.cwiseAbs().maxCoeff() / largest_part)) : 1;
}

/// Each muscle for itself, its neighbours where they were seen last.
bool settle_each(Limb& limb, double wanted_share, WorkerPool& workers) {
  std::vector<char> settled(limb.muscles.size(), 1);
  workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
    const auto i = static_cast<std::size_t>(m);
    if (is_solved(limb.muscles[i]))
      settled[i] = settle_muscle(limb.skeleton, limb.gravity_m_s2, wanted_share, limb.muscles[i]);
  });
  return std::all_of(settled.begin(), settled.end(), [](char s) { return s != 0; });
}

bool touching(const Limb& limb) {
  return std::any_of(limb.muscles.begin(), limb.muscles.end(),
                     [](const LimbMuscle& muscle) { return !muscle.state.touches.empty(); });
}

/// One by one first, which stands anything; where muscles touch, then all together.
bool settle_all(Limb& limb, double wanted_share, WorkerPool& workers) {
  find_touches(limb, workers);
  const bool settled = settle_each(limb, touching(limb) ? kRoughShare : wanted_share, workers);
  find_touches(limb, workers);
  return touching(limb) ? settle_together(limb, wanted_share, workers) : settled;
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
  evaluate_lines(limb, TimeRule{});
  for (LimbMuscle& muscle : limb.muscles) {
    if (muscle.line) bring_to_rest(muscle.state.activation, *muscle.line);
  }
  read_out(limb);
  limb.springs.clear();
  limb.spring_force_N.clear();
  limb.spring_compliance_m_N.clear();
}

/// -d(torque)/d(angle) about every joint, the nodes following as they do.
Eigen::VectorXd followed_stiffness(const LimbMuscle& muscle) {
  return (muscle.system.joint_stiffness_Nm_rad - muscle.system.coupling_N_rad.transpose() * muscle.follow_m_rad)
      .diagonal();
}

/// How the nodes of all muscles follow the joints in equilibrium, and -d(torque)/d(angle) from it, one column a muscle.
/// NaN where a tangent is singular.
Eigen::MatrixXd eliminated_stiffness(Limb& limb, const TissueLoad& load, WorkerPool& workers) {
  const int count = static_cast<int>(limb.muscles.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Constant(limb.skeleton.joint_count(), count, std::nan(""));
  std::vector<char> usable(limb.muscles.size(), 1);
  workers.run(count, [&](int m) {
    LimbMuscle& muscle = limb.muscles[static_cast<std::size_t>(m)];
    if (!is_solved(muscle)) return;
    compute_system(limb.skeleton, load, muscle, Accuracy::Refined);
    const Pivots pivots = factor_system(muscle, muscle.system.coupling_N_rad, muscle.follow_m_rad, Accuracy::Refined);
    muscle.follows = pivots != Pivots::Unusable && muscle.follow_m_rad.allFinite();
    usable[static_cast<std::size_t>(m)] = pivots != Pivots::Unusable;
  });
  if (std::find(usable.begin(), usable.end(), 0) == usable.end()) couple_follow(limb, workers);
  for (int m = 0; m < count; ++m) {
    const LimbMuscle& muscle = limb.muscles[static_cast<std::size_t>(m)];
    if (is_solved(muscle) && usable[static_cast<std::size_t>(m)]) stiffness.col(m) = followed_stiffness(muscle);
  }
  return stiffness;
}

}  // namespace

bool settle_muscle(const Skeleton& skeleton, const Vec3& gravity_m_s2, double wanted_share, LimbMuscle& muscle) {
  const TissueLoad load = static_load(gravity_m_s2);
  muscle.state.last.velocity_m_s.setZero();
  std::fill(muscle.state.stretch_rate_1_s.begin(), muscle.state.stretch_rate_1_s.end(), 0.0);
  compute_forces(muscle.tissue, skeleton, load, muscle.state, muscle.system);
  double time_s = kFirstTime_s;
  for (int iteration = 0; iteration < kMostIterations && !(rest_share(muscle) < wanted_share); ++iteration) {
    Eigen::MatrixXd direction;
    if (!find_direction(skeleton, load, time_s, muscle, direction)) return false;
    const double part = search_line(skeleton, load, direction, muscle);
    if (part == 0.0 && time_s <= kShortestTime_s) break;
    time_s = next_time_s(time_s, part);
  }
  return rest_share(muscle) < wanted_share;
}

bool settle_limb(Limb& limb, std::span<const double> angles_rad, std::span<const double> activations,
                 WorkerPool& workers) {
  const Eigen::VectorXd start = limb.now.angle_rad;
  const Eigen::VectorXd goal = Eigen::Map<const Eigen::VectorXd>(angles_rad.data(), start.size());
  const Eigen::VectorXd start_activations = activations_of(limb);
  const Eigen::VectorXd goal_activations =
      Eigen::Map<const Eigen::VectorXd>(activations.data(), start_activations.size());
  wake_unsettled(limb, goal, goal_activations);
  const int parts = std::max(
      {1, parts_of(goal - start, kLargestPart_rad),
       limb.touch_surfaces.empty() ? 1 : parts_of(goal_activations - start_activations, kLargestActivationPart)});
  limb.skeleton.set_pose(limb.angles());
  bool settled = true;
  for (int part = 1; part <= parts; ++part) {
    const double share = static_cast<double>(part) / parts;
    activate(limb, part == parts ? goal_activations
                                 : Eigen::VectorXd(start_activations + share * (goal_activations - start_activations)));
    turn_to(limb, start + (goal - start) * share);
    settled = settle_all(limb, part == parts ? kRestShare : kRoughShare, workers);
  }
  bring_to_rest(limb);
  return settled;
}

bool settle_limb(Limb& limb, std::span<const double> angles_rad, WorkerPool& workers) {
  const Eigen::VectorXd held = activations_of(limb);
  return settle_limb(limb, angles_rad, {held.data(), limb.muscles.size()}, workers);
}

void refresh_muscle_stiffness(const Limb& limb, LimbMuscle& muscle) {
  if (muscle.line) {
    LineTissue resting = *muscle.line;
    const LineLoad load = evaluate_line_tissue(limb.skeleton, TimeRule{}, muscle.state.activation, resting);
    muscle.stiffness_Nm_rad = load.stiffness_Nm_rad.diagonal();
  }
  if (muscle.rigid) return;
  compute_system(limb.skeleton, static_load(limb.gravity_m_s2), muscle, Accuracy::Refined);
  Eigen::MatrixXd right = muscle.system.coupling_N_rad, follow;
  subtract_followed_coupling(limb, muscle, right);
  muscle.follows = factor_system(muscle, right, follow, Accuracy::Refined) != Pivots::Unusable && follow.allFinite();
  if (!muscle.follows) return;
  muscle.follow_m_rad = follow;
  const Eigen::VectorXd stiffness = followed_stiffness(muscle);
  if (stiffness.allFinite()) muscle.stiffness_Nm_rad = stiffness;
}

void refresh_stiffness(Limb& limb, WorkerPool& workers) {
  TissueLoad held = static_load(limb.gravity_m_s2);
  held.contact_held = true;
  const bool touches = !limb.touch_surfaces.empty();
  const Eigen::MatrixXd without = touches ? eliminated_stiffness(limb, held, workers) : Eigen::MatrixXd();
  const Eigen::MatrixXd whole = eliminated_stiffness(limb, static_load(limb.gravity_m_s2), workers);
  for (std::size_t m = 0; m < limb.muscles.size(); ++m) {
    LimbMuscle& muscle = limb.muscles[m];
    if (muscle.line) refresh_muscle_stiffness(limb, muscle);
    const Eigen::VectorXd stiffness = whole.col(static_cast<Eigen::Index>(m));
    if (muscle.rigid || !stiffness.allFinite()) continue;
    muscle.stiffness_Nm_rad = stiffness;
    muscle.contact_stiffness_Nm_rad.setZero();
    if (!touches) continue;
    const Eigen::VectorXd contact = stiffness - without.col(static_cast<Eigen::Index>(m));
    if (contact.allFinite()) muscle.contact_stiffness_Nm_rad = contact;
  }
}

}  // namespace myotact::simulation
