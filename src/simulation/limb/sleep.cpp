#include "simulation/limb/sleep.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"

namespace myotact::simulation {
namespace {

/// A muscle stands still when no node is faster along an axis than this beside how it follows the joints [m/s], and as
/// near to rest as below: bellies swing at some 3 Hz, by 0.1 mm at this speed, and for seconds.
constexpr double kStill_m_s = 2e-3;
/// Change of activation that wakes [0 .. 1]; the half of it keeps awake.
constexpr double kSameActivation = 1e-3;
/// Angle that a joint may take from where the load of those that span it was linearised [rad].
constexpr double kLinear_rad = 0.004;
/// Beyond this, the load is worth being made anew when there is time [rad]: the stiffness of muscles that are nearly
/// slack changes by a twentieth over the whole of the angle above.
constexpr double kStale_rad = 1e-4;
/// Speed of a joint that wakes active muscles which span it [rad/s], for these damp; half of it keeps them awake.
constexpr double kSlow_rad_s = 0.05;
constexpr double kPassive = 1e-3;  // activation of a muscle that damps nothing
/// Acceleration of a joint that wakes those that it moves [rad/s^2], for their mass lags behind: 2 m/s^2 at the paw.
/// Half of it keeps them awake.
constexpr double kGentle_rad_s2 = 10.0;
/// A static step that moves a node farther than this [m] has not come to rest: slack muscles buckle, and those that
/// become taut pull all at once. The others are moved by 0.1 to 30 um when their load is made anew (a forelimb).
constexpr double kNearRest_m = 5e-5;
/// The nodes stay while no joint has rotated by more than this since they were placed [rad]: 0.3 um at the paw.
constexpr double kUnseen_rad = 1e-6;

/// Every body that has a part in the muscle's forces, those included on whose bones it may lie.
std::vector<int> bodies_of(const LimbMuscle& muscle) {
  const MuscleTissue& tissue = muscle.tissue;
  std::vector<int> bodies = tissue.bodies;
  bodies.insert(bodies.end(), {tissue.insertion_body, tissue.before_insertion_body});
  if (tissue.insertion_wrap) bodies.push_back(tissue.insertion_wrap->body);
  for (const TendonStrand& strand : tissue.strands) {
    for (const TendonStrand::BodyPoint& point : strand.points) {
      bodies.push_back(point.body);
      if (point.wrap) bodies.push_back(point.wrap->body);
    }
  }
  for (const NearBones::Node& near : muscle.state.near_bones.nodes) {
    const BoneContact& contact = tissue.bone_contact;
    const int body = (*contact.bones)[at(contact.patches[at(near.patch)].bone)].body;
    if (std::find(bodies.begin(), bodies.end(), body) == bodies.end()) bodies.push_back(body);
  }
  std::erase(bodies, -1);
  return bodies;
}

/// Weight goes on pointing down when a joint carries the muscle along: it then counts as one that strains the muscle.
std::vector<JointPart> parts_of_joints(const Limb& limb, const std::vector<int>& bodies) {
  const bool weighs = !limb.gravity_m_s2.isZero(0.0);
  std::vector<JointPart> parts;
  for (int j = 0; j < limb.skeleton.joint_count(); ++j) {
    const auto moved =
        std::count_if(bodies.begin(), bodies.end(), [&](int body) { return limb.skeleton.is_distal(body, j); });
    const bool carries = moved == std::ssize(bodies) && !weighs;
    parts.push_back(moved == 0 ? JointPart::None : carries ? JointPart::Carries : JointPart::Strains);
  }
  return parts;
}

/// The body that those joints move which carry the muscle, and no others; -1: there is none.
int carrier_of(const Skeleton& skeleton, const std::vector<JointPart>& parts) {
  for (int body = 0; body < skeleton.body_count(); ++body) {
    bool alike = true;
    for (int j = 0; j < skeleton.joint_count(); ++j) {
      alike &= skeleton.is_distal(body, j) == (parts[at(j)] == JointPart::Carries);
    }
    if (alike) return body;
  }
  return -1;
}

/// Where all nodes go when a joint rotates, the free ones in equilibrium [m/rad]: 3 rows a node, one column a joint.
Eigen::MatrixXd motion_of(const Limb& limb, const LimbMuscle& muscle) {
  const MuscleTissue& tissue = muscle.tissue;
  Eigen::MatrixXd motion(muscle.state.now.position_m.size(), limb.skeleton.joint_count());
  for (int node = 0; node < static_cast<int>(tissue.body.size()); ++node) {
    const int f = tissue.free_index[at(node)];
    const Vec3 p = node_vector(muscle.state.now.position_m, node);
    for (int j = 0; j < limb.skeleton.joint_count(); ++j) {
      motion.col(j).segment<3>(3 * node) = f >= 0 ? Vec3(-muscle.follow_m_rad.col(j).segment<3>(3 * f))
                                                  : limb.skeleton.point_derivative(tissue.body[at(node)], j, p);
    }
  }
  return motion;
}

/// Mass of the tissue as the joints feel it when its nodes go along [kg m^2].
Eigen::MatrixXd inertia_of(const MuscleTissue& tissue, const Eigen::MatrixXd& motion_m_rad) {
  Eigen::VectorXd mass_kg(motion_m_rad.rows());
  for (std::size_t node = 0; node < tissue.mass_kg.size(); ++node) {
    mass_kg.segment<3>(static_cast<Eigen::Index>(3 * node)).setConstant(tissue.mass_kg[node]);
  }
  return motion_m_rad.transpose() * mass_kg.asDiagonal() * motion_m_rad;
}

void put_nodes(const Limb& limb, LimbMuscle& muscle) {
  Sleep& sleep = *muscle.sleep;
  Eigen::VectorXd turned_rad = limb.now.angle_rad - sleep.angle_rad;
  for (Eigen::Index j = 0; j < turned_rad.size(); ++j) {
    if (sleep.joints[static_cast<std::size_t>(j)] != JointPart::Strains) turned_rad[j] = 0.0;
  }
  Eigen::VectorXd& position_m = muscle.state.now.position_m;
  position_m = sleep.position_m + sleep.motion_m_rad * turned_rad;
  if (sleep.carrier >= 0) {
    const Pose carried = limb.skeleton.body_pose(sleep.carrier) * sleep.carrier_pose.inverse();
    for (Eigen::Index i = 0; i < position_m.size(); i += 3) {
      position_m.segment<3>(i) = carried * Vec3(position_m.segment<3>(i));
    }
  }
  place_clamped(muscle.tissue, limb.skeleton, muscle.state);
  muscle.state.last.position_m = muscle.state.before.position_m = position_m;
  sleep.placed_rad = limb.now.angle_rad;
}

/// What the joints feel of the muscle about the limb's pose, from its last static system and how its nodes follow.
void linearise(const Limb& limb, LimbMuscle& muscle) {
  Sleep& sleep = *muscle.sleep;
  sleep.angle_rad = sleep.placed_rad = limb.now.angle_rad;
  if (sleep.carrier >= 0) sleep.carrier_pose = limb.skeleton.body_pose(sleep.carrier);
  sleep.position_m = muscle.state.now.position_m;
  sleep.motion_m_rad = motion_of(limb, muscle);
  sleep.residual_Nm = muscle.system.joint_residual_Nm;
  sleep.torque_Nm = muscle.system.muscle_torque_Nm;
  sleep.stiffness_Nm_rad =
      muscle.system.joint_stiffness_Nm_rad - muscle.system.coupling_N_rad.transpose() * muscle.follow_m_rad;
  sleep.inertia_kg_m2 = inertia_of(muscle.tissue, sleep.motion_m_rad);
}

TissueLoad at_rest(const Limb& limb) {
  TissueLoad load;
  load.gravity_m_s2 = limb.gravity_m_s2;
  return load;
}

/// At rest where it is; the fibres have the length that they have there.
void wake(const Limb& limb, LimbMuscle& muscle) {
  put_nodes(limb, muscle);
  compute_forces(muscle.tissue, limb.skeleton, at_rest(limb), muscle.state, muscle.system);
  muscle.state.last = muscle.state.before = muscle.state.now;
  muscle.sleep.reset();
}

/// A sleeping muscle's load about the present pose: one static step from where its nodes were taken, for they are no
/// farther from rest than by what is of second order. One that is wakes.
void linearise_again(const Limb& limb, LimbMuscle& muscle) {
  put_nodes(limb, muscle);
  compute_system(limb.skeleton, at_rest(limb), muscle, Accuracy::Refined);
  TissueSystem& system = muscle.system;
  Eigen::MatrixXd sides(system.residual_N.size(), 1 + system.coupling_N_rad.cols()), solution;
  sides << system.residual_N, system.coupling_N_rad;
  muscle.follows =
      factor_system(muscle, sides, solution, Accuracy::Refined) != Pivots::Unusable && solution.allFinite();
  if (!muscle.follows || solution.col(0).lpNorm<Eigen::Infinity>() > kNearRest_m) return wake(limb, muscle);
  const Eigen::VectorXd to_rest_Nm = system.coupling_N_rad.transpose() * solution.col(0);
  system.joint_residual_Nm -= to_rest_Nm;
  system.muscle_torque_Nm += to_rest_Nm;
  move_free_nodes(muscle, -solution.col(0));
  muscle.follow_m_rad = solution.rightCols(system.coupling_N_rad.cols());
  linearise(limb, muscle);
  muscle.sleep->settled = false;
  muscle.stiffness_Nm_rad = muscle.sleep->stiffness_Nm_rad.diagonal();
  muscle.state.last = muscle.state.before = muscle.state.now;
}

bool is_pulled(const Limb& limb, int muscle) {
  return std::any_of(limb.springs.begin(), limb.springs.end(),
                     [&](const ToolSpring& spring) { return spring.muscle == muscle; });
}

/// No joint shakes the muscle, and none that strains it rotates so fast that its fibres would damp. `share`: of the
/// limits.
bool is_gentle(const Limb& limb, double dt_s, const std::vector<JointPart>& joints, double activation, double share) {
  for (int j = 0; j < limb.skeleton.joint_count(); ++j) {
    if (joints[at(j)] == JointPart::None) continue;
    const double speed_rad_s = limb.now.velocity_rad_s[j], last_rad_s = limb.last.velocity_rad_s[j];
    if (std::abs(speed_rad_s - last_rad_s) > share * kGentle_rad_s2 * dt_s) return false;
    const bool damps = joints[at(j)] == JointPart::Strains && activation > kPassive;
    if (damps && std::abs(speed_rad_s) > share * kSlow_rad_s) return false;
  }
  return true;
}

/// How far the joints that strain the muscle have gone since its load was made linear.
double strained_rad(const Limb& limb, const Sleep& sleep) {
  double farthest_rad = 0.0;
  for (int j = 0; j < limb.skeleton.joint_count(); ++j) {
    if (sleep.joints[at(j)] == JointPart::Strains)
      farthest_rad = std::max(farthest_rad, std::abs(limb.now.angle_rad[j] - sleep.angle_rad[j]));
  }
  return farthest_rad;
}

}  // namespace

bool may_sleep(const Limb& limb, int index, double excitation, double dt_s) {
  const LimbMuscle& muscle = limb.muscles[at(index)];
  const double activation = muscle.state.activation;
  if (!is_solved(muscle) || !muscle.follows || !limb.touch_surfaces.empty() || is_pulled(limb, index)) return false;
  if (std::abs(excitation - activation) > 0.5 * kSameActivation) return false;
  const Eigen::VectorXd own_m_s = muscle.state.now.velocity_m_s - motion_of(limb, muscle) * limb.now.velocity_rad_s;
  if (!(own_m_s.lpNorm<Eigen::Infinity>() < kStill_m_s)) return false;
  return is_gentle(limb, dt_s, parts_of_joints(limb, bodies_of(muscle)), activation, 0.5);
}

void fall_asleep(Limb& limb, int index, AfterSettle after_settle) {
  LimbMuscle& muscle = limb.muscles[at(index)];
  Sleep& sleep = muscle.sleep.emplace();
  sleep.activation = muscle.state.activation;
  sleep.settled = after_settle == AfterSettle::Yes;
  sleep.joints = parts_of_joints(limb, bodies_of(muscle));
  sleep.carrier = carrier_of(limb.skeleton, sleep.joints);
  muscle.state.now.velocity_m_s.setZero();
  std::fill(muscle.state.stretch_rate_1_s.begin(), muscle.state.stretch_rate_1_s.end(), 0.0);
  muscle.state.last = muscle.state.before = muscle.state.now;
  linearise(limb, muscle);
  if (after_settle == AfterSettle::No) linearise_again(limb, muscle);
}

void wake_disturbed(Limb& limb, double dt_s) {
  for (int m = 0; m < static_cast<int>(limb.muscles.size()); ++m) {
    LimbMuscle& muscle = limb.muscles[at(m)];
    if (!muscle.sleep) continue;
    const double activation = muscle.state.activation;
    const bool same = std::abs(activation - muscle.sleep->activation) <= kSameActivation;
    if (!same || is_pulled(limb, m) || !is_gentle(limb, dt_s, muscle.sleep->joints, activation, 1.0))
      wake(limb, muscle);
  }
}

void wake_unsettled(Limb& limb, const Eigen::VectorXd& angles_rad, const Eigen::VectorXd& activations) {
  for (std::size_t m = 0; m < limb.muscles.size(); ++m) {
    LimbMuscle& muscle = limb.muscles[m];
    if (!muscle.sleep) continue;
    const Sleep& sleep = *muscle.sleep;
    const bool stays = sleep.settled && sleep.activation == activations[static_cast<Eigen::Index>(m)] &&
                       sleep.angle_rad == angles_rad && limb.now.angle_rad == angles_rad;
    if (!stays) wake(limb, muscle);
  }
}

void wake_all(Limb& limb) {
  for (LimbMuscle& muscle : limb.muscles) {
    if (muscle.sleep) wake(limb, muscle);
  }
}

void evaluate_sleepers(Limb& limb, const TimeRule& rule) {
  const Eigen::VectorXd acceleration_rad_s2 = joint_acceleration_rad_s2(limb, rule);
  for (LimbMuscle& muscle : limb.muscles) {
    if (!muscle.sleep) continue;
    const Sleep& sleep = *muscle.sleep;
    const Eigen::VectorXd change_Nm = sleep.stiffness_Nm_rad * (limb.now.angle_rad - sleep.angle_rad);
    muscle.system.joint_residual_Nm = sleep.residual_Nm + change_Nm + sleep.inertia_kg_m2 * acceleration_rad_s2;
    muscle.system.muscle_torque_Nm = sleep.torque_Nm - change_Nm;
    muscle.system.joint_stiffness_Nm_rad = sleep.stiffness_Nm_rad + rule.rate_1_s * rule.rate_1_s * sleep.inertia_kg_m2;
  }
}

bool is_stale(const Limb& limb, int muscle) {
  const std::optional<Sleep>& sleep = limb.muscles[at(muscle)].sleep;
  return sleep && strained_rad(limb, *sleep) > kStale_rad;
}

void place_sleepers(Limb& limb, int renewed, WorkerPool& workers) {
  std::vector<int> moved;
  for (int m = 0; m < static_cast<int>(limb.muscles.size()); ++m) {
    const std::optional<Sleep>& sleep = limb.muscles[at(m)].sleep;
    if (!sleep) continue;
    const double turned_rad = (limb.now.angle_rad - sleep->placed_rad).lpNorm<Eigen::Infinity>();
    if (m == renewed || turned_rad > kUnseen_rad) moved.push_back(m);
  }
  workers.run(static_cast<int>(moved.size()), [&](int k) {
    LimbMuscle& muscle = limb.muscles[at(moved[at(k)])];
    if (moved[at(k)] == renewed || strained_rad(limb, *muscle.sleep) > kLinear_rad)
      linearise_again(limb, muscle);
    else
      put_nodes(limb, muscle);
  });
}

}  // namespace myotact::simulation
