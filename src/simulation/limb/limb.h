#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/pose.h"
#include "simulation/contact/contact_law.h"
#include "simulation/follower/follower.h"
#include "simulation/line/line_tissue.h"
#include "simulation/linear/block_factor.h"
#include "simulation/muscle/tissue_system.h"
#include "simulation/muscle/touch_surface.h"
#include "simulation/skeleton/skeleton_loads.h"
#include "simulation/skin/skin_embedding.h"
#include "simulation/worker_pool.h"

namespace myotact::simulation {

/// A spring between a place in the world and a material point of a muscle or a point of a body.
struct ToolSpring {
  int tool = 0;         // whose it is, in the order of the step's tools
  int surface = -1;     // of the scene, for the spring of a contact; -1: of something in hand
  int muscle = -1;      // or -1: `body` and `body_rest_m` say where
  MaterialPoint point;  // of the muscle's mesh, when `muscle` is given
  int body = -1;
  Vec3 body_rest_m = Vec3::Zero();  // L
  Vec3 target_W_m = Vec3::Zero();   // the spring's end in the world
  double stiffness_N_m = 0.0;       // > 0, no rest length
  Vec3 normal_W = Vec3::Zero();     // of a contact: out of the tissue
  bool open = false;                // of a contact: found to pull in this Newton step, and so without force
  bool ahead = false;               // no contact yet, of the surface next to the tool: its force is next to nothing
};

/// What a muscle does at the end of a step or settle.
struct MuscleReadout {
  Eigen::VectorXd torque_Nm;     // one a joint, positive flexes
  double tension_N = 0.0;        // on its insertion
  double smallest_J = 1.0;       // volume ratio over the integration points
  double volume_ratio = 1.0;     // of the whole muscle
  double contact_N = 0.0;        // sum of the contact forces on its surface
  double contact_depth_m = 0.0;  // largest overlap, over that at the file pose
};

/// What a joint does to a muscle as it rotates: nothing, strain it, or carry the whole of it along.
enum class JointPart { None, Strains, Carries };

/// A muscle asleep (sleep.h): a load on the joints, linear about one pose of them. What else is read out of it
/// (tension, volume, least J) is as in that pose.
struct Sleep {
  double activation = 0.0;        // where it fell asleep
  bool settled = false;           // it did so at the end of a settle, and its load is still that one
  std::vector<JointPart> joints;  // one a joint
  int carrier = -1;               // body that exactly those joints move which carry the muscle; -1: none
  // in that pose
  Eigen::VectorXd angle_rad;         // of all joints
  Pose carrier_pose;                 // X_WL
  Eigen::VectorXd position_m;        // of all nodes, world
  Eigen::MatrixXd motion_m_rad;      // of all nodes against the angles, in equilibrium
  Eigen::VectorXd residual_Nm;       // minus the torque on the joints, weight included
  Eigen::VectorXd torque_Nm;         // of the tissue on the joints, positive flexes
  Eigen::MatrixXd stiffness_Nm_rad;  // joints x joints, nodes in equilibrium
  Eigen::MatrixXd inertia_kg_m2;     // joints x joints, of the nodes going along
  Eigen::VectorXd placed_rad;        // angles for which the nodes were placed last
};

/// One muscle: model, state, and what a solve leaves behind. Owned by one task at a time.
struct LimbMuscle {
  MuscleTissue tissue;                 // what does not change
  bool rigid = false;                  // its shape follows the bones: no nodes to solve for
  std::optional<Follower> follower;    // of a rigid muscle: how
  std::optional<LineTissue> line;      // of a Line muscle, which is rigid, too
  TissueState state;                   // the iterate and two instants before it
  TissueSystem system;                 // of the last pass
  Eigen::VectorXd mean_solution;       // factor^-1 mean gradient
  double mean_share_Nm = 0.0;          // by which the mean term changes a solution, see solve()
  Eigen::VectorXd free_solution;       // matrix^-1 residual
  std::vector<Eigen::Index> unknowns;  // of the small system that enter its equations: joints, then its own springs
  Eigen::MatrixXd borders;             // free dofs x unknowns: how
  bool borders_stale = false;          // a spring that was open may press again, which they leave out
  Eigen::MatrixXd border_solution;     // matrix^-1 borders
  Eigen::MatrixXd reduced;             // borders^T matrix^-1 borders
  Eigen::VectorXd reduced_residual;    // borders^T matrix^-1 residual
  Eigen::VectorXd start_m, change_m;   // of the Newton step: nodes where it starts, change of the free ones
  Eigen::VectorXd coupled_m;           // what contact with neighbours adds to that change; empty: none
  Eigen::MatrixXd follow_m_rad;        // matrix^-1 coupling, in the last stiffness: free nodes follow by minus this
  bool follows = false;                // the last refresh of the stiffness came to such a solution
  double energy_slope = 0.0;           // along that change
  double residual_share = 0.0;         // out-of-balance force over the size of the forces, springs included
  bool balanced = false;               // within this step: needs no new tangent
  bool strained = false;               // one Newton step of this step was not enough
  std::optional<TimeRule> kept_rule;   // of the step whose factored tangent serves the next one, too; none: it does not
  bool made_definite = false;          // the last tangent is
  int definite_tangents = 0;           // how many more are, before the true one is tried again
  bool sound = true;                   // the last factorisation and state were finite
  std::optional<Sleep> sleep;          // none: awake
  MuscleReadout readout;               // of the last step or settle
  Eigen::VectorXd stiffness_Nm_rad;    // quasi-static, one a joint, of the last refresh
  Eigen::VectorXd contact_stiffness_Nm_rad;  // what contact adds to it, of the last such refresh
};

/// A shape on its bones: neither its tissue nor its line is solved for.
inline bool only_follows(const LimbMuscle& muscle) {
  return muscle.rigid && !muscle.line;
}

/// Its nodes are unknowns of a step: it neither follows its bones nor sleeps.
inline bool is_solved(const LimbMuscle& muscle) {
  return !muscle.rigid && !muscle.sleep;
}

/// Angles of all joints at one instant, and their rates. One a joint, positive flexes.
struct JointFrameState {
  Eigen::VectorXd angle_rad;
  Eigen::VectorXd velocity_rad_s;
};

/// Everything that moves, and what a step needs. See step.h and settle.h. One caller; only what takes a single muscle
/// may run for several muscles at once.
struct Limb {
  /// `models`: one a muscle; empty: all Fem. `tendon`: of the Line ones. `contact`: what the others touch. `fascia`:
  /// holds those that lie side by side. At the file pose, at rest. Throws Error BadData as Skeleton,
  /// build_muscle_tissue() and make_line_tissue() do.
  explicit Limb(const anatomy::Specimen& specimen, std::span<const TissueModel> models = {},
                Tendon tendon = Tendon::Elastic, Contact contact = Contact::All, const Fascia& fascia = {});

  Skeleton skeleton;                         // in the pose of `now`
  SkeletonLoads loads;                       // computed last
  JointFrameState now, last, before;         // as in TissueState
  Eigen::VectorXd external_torque_Nm;        // one a joint, positive flexes
  Vec3 gravity_m_s2 = Vec3::Zero();          // W
  std::vector<LimbMuscle> muscles;           // as in the specimen
  Contact contact = Contact::All;            // as given
  Fascia fascia;                             // as given
  std::vector<TouchSurface> touch_surfaces;  // one a muscle; none where muscles neither touch nor hold each other
  std::vector<ToolSpring> springs;           // of the present step
  std::vector<Vec3> spring_force_N;          // on the tissue or bone, at the end of the step
  std::vector<Mat3> spring_compliance_m_N;   // of what each pulls at, or its sphere; its tool's springs left out

  /// now.angle_rad as a view.
  std::span<const double> angles() const {
    return {now.angle_rad.data(), static_cast<std::size_t>(now.angle_rad.size())};
  }
};

/// Two contacts of one tool. They hold one sphere, which its coupling spring holds:
///
///   hand --/coupling/-- sphere --/seat/-- each point
///
/// so that what the points bear together is what the coupling spring does, and each bears more the less it gives way.
inline bool of_one_sphere(const ToolSpring& a, const ToolSpring& b) {
  return a.tool == b.tool && a.surface >= 0 && b.surface >= 0;
}
/// Compliance of a seat [m/N], 3 % of the coupling's: so that rigid points share a force. None where a sphere has
/// one point alone, and of what is no contact.
double seat_m_N(const Limb& limb, const ToolSpring& spring);
/// Force of a spring on what it pulls at, in the present iterate [N, world]; 0 for an open one.
Vec3 spring_force(const Limb& limb, std::size_t spring);

/// Where the material point of a spring is in the present iterate, in the world.
Vec3 spring_point(const Limb& limb, const ToolSpring& spring);
/// d(spring point)/d(angle) [m/rad] with the free nodes held: through clamped nodes or the body alone.
Vec3 spring_slope(const Limb& limb, const ToolSpring& spring, int joint);

/// Puts the bodies and the clamped nodes of who is solved for where the present angles say; of the rigid muscles those
/// that a spring pulls at.
void follow_angles(Limb& limb);
/// Puts a rigid muscle where the skeleton's pose has it; others stay. After a step or a settle, for nothing in a solve
/// reads these nodes. Several muscles may be placed at once.
void place_follower(Limb& limb, int muscle);

/// Adds `change_m` (3 numbers a free node, world) to the present positions.
void move_free_nodes(LimbMuscle& muscle, const Eigen::VectorXd& change_m);

/// Loads of the Line muscles in the present pose, at the end of a step by `rule` (all zero: at rest), into their
/// systems; torque and tension into their readouts.
void evaluate_lines(Limb& limb, const TimeRule& rule);

/// Where a hash of add_to_hash() begins.
inline constexpr std::uint64_t kHashStart = 14695981039346656037ull;
/// Equal for equal bits of everything that moves: angles, positions, their rates, activations, fibres of Line muscles.
std::uint64_t hash_of_state(const Limb& limb);
/// FNV-1a over the bytes of more numbers; bits count, so that 0 and -0 differ.
void add_to_hash(std::span<const double> values, std::uint64_t& hash);

/// Copies the outcome of the last forces pass to the muscles' readouts, and the bones' loads to `limb.loads`.
void read_out(Limb& limb);

/// Of the joints in the present iterate, at the end of a step by `rule`.
Eigen::VectorXd joint_velocity_rad_s(const Limb& limb, const TimeRule& rule);
Eigen::VectorXd joint_acceleration_rad_s2(const Limb& limb, const TimeRule& rule);

/// All present rates zero; the pose stays, and so does the history.
void stop_moving(Limb& limb);

/// All joints at the file pose, all tissue at its rest positions, no rates, no activation, no stiffness known.
/// Locks, gravity, external torques and springs stay.
void return_to_file_pose(Limb& limb);

/// Single: for a Newton step, whose residual shows what is left. Refined: for a solution that is read out itself.
enum class Accuracy { Single, Refined };
/// Tangent and residual of the present iterate of one muscle that is not rigid, for factor_system() of the same
/// accuracy.
void compute_system(const Skeleton& skeleton, TissueLoad load, LimbMuscle& muscle,
                    Accuracy accuracy = Accuracy::Single);
/// Factors the system, its mean term included, and solves it for `right` (free dofs x any number of columns). Once
/// after compute_system(). Unusable: neither the solution nor solve() may be used.
Pivots factor_system(LimbMuscle& muscle, const Eigen::MatrixXd& right, Eigen::MatrixXd& solution,
                     Accuracy accuracy = Accuracy::Single);
/// (matrix + mean term)^-1 right with the last factors.
Eigen::MatrixXd solve(const LimbMuscle& muscle, const Eigen::MatrixXd& right);

}  // namespace myotact::simulation
