#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "anatomy/specimen.h"
#include "core/pose.h"
#include "core/vector.h"
#include "messages/local_model.h"
#include "messages/scene_frame.h"
#include "messages/tool_state.h"
#include "simulation/contact/contact_law.h"
#include "simulation/line/hill_muscle.h"
#include "simulation/muscle/tissue_model.h"
#include "simulation/particle/tether.h"

namespace myotact::simulation {

struct TissueMechanics;
struct TissueSnapshot;

/// How a Simulation is built; fixed from then on, but for gravity. World frame.
struct SimulationSettings {
  double dt_s = 0.01;                // step, in (0, 0.1]
  Vec3 gravity_m_s2 = Vec3::Zero();  // W
  int workers = 2;                   // threads of a step, the caller's included; the result does not depend on it
  std::vector<TissueModel> tissue;   // one a muscle; empty: all Fem
  Tendon tendon = Tendon::Elastic;   // of the Line muscles
  Contact contact = Contact::All;    // bones alone are cheap, each other is not
  Fascia fascia = {};                // holds muscles to each other that lie side by side at the file pose; zero: none
  std::optional<TetherSettings> tether = {};  // then nothing else is felt
  bool sleep = true;   // muscles that nothing moves are not solved for (limb/sleep.h); false is to compare with
  bool shapes = true;  // muscles that only follow bones are fitted to them; false is for what nobody looks at
};

/// Joint stiffness K = -d(net torque)/dq at held activations and held other joints, and what it is made of. All about
/// the joint's axis, positive flexes.
struct JointReadout {
  double angle_rad = 0.0;         // 0 at the file pose, positive flexes
  double velocity_rad_s = 0.0;    // at the end of the last step
  double net_torque_Nm = 0.0;     // of all muscles on the joint, positive flexes
  double own_torque_Nm = 0.0;     // of the joint's spring and stop, the bones' weight and centrifugal terms; no damping
  double stiffness_Nm_rad = 0.0;  // Schur complement of the quasi-static system, passive joint included
  double line_muscle_Nm_rad = 0.0;    // sum r^2 k of the muscle lines
  double line_geometry_Nm_rad = 0.0;  // -sum (dr/dq) F of the muscle lines
  double contact_Nm_rad = 0.0;  // of the stiffness: lost if contact forces stayed as they are while the joint rotates
  double passive_Nm_rad = 0.0;  // the joint's own
  double inertia_kg_m2 = 0.0;   // of all bones distal to the joint, about its axis; muscles not included
  double joint_damping_Nms_rad = 0.0;  // the joint's own
  double damping_Nms_rad = 0.0;        // of the joint itself and the muscle lines' fibres, sum r^2 b
  bool preview = false;  // a mass-spring muscle spans the joint: torque and stiffness are no more than a preview
};

/// One muscle's part in a joint's readout. All zero for a Rigid muscle, which is a shape only.
struct MuscleAtJoint {
  double torque_Nm = 0.0;               // positive flexes
  double stiffness_Nm_rad = 0.0;        // of the quasi-static tissue, as of the last refresh
  double contact_Nm_rad = 0.0;          // of that stiffness, as of the last settle
  double line_muscle_Nm_rad = 0.0;      // r^2 k of its line
  double line_geometry_Nm_rad = 0.0;    // -(dr/dq) F of its line
  double line_damping_Nms_rad = 0.0;    // r^2 b of its line's fibres
  double moment_arm_m = 0.0;            // r of its line, positive flexes
  double moment_arm_slope_m_rad = 0.0;  // dr/dq
  std::optional<HillForce> unit;        // of a Line muscle: fibres and tendon at rest at the present length
};

/// Soft muscles on a skeleton, advanced by a fixed implicit step. Single caller; makes its own workers. Not for the
/// haptic thread: step(), settle() and the outputs that return or fill containers allocate. `muscle`, `joint` and
/// `body` are indices into the specimen's lists and not checked.
class Simulation {
 public:
  /// Builds meshes, factors' patterns, embeddings; calibrates the fibres. The specimen is copied. Throws Error BadData
  /// when the specimen cannot be simulated, dt_s is out of range or `tissue` does not name one model a muscle.
  Simulation(const anatomy::Specimen& specimen, const SimulationSettings& settings);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  // ---- input, between steps
  /// Drives the activation's first-order lag. Clamped to 0 .. 1, NaN counts as 0.
  void set_excitation(int muscle, double excitation);
  /// A locked joint keeps its angle; its velocity becomes 0 at every change.
  void set_joint_locked(int joint, bool locked);
  /// W. From the next step or settle on.
  void set_gravity(const Vec3& gravity_m_s2);
  /// External torque about a joint, positive flexes; held until set again. Not finite counts as 0.
  void set_joint_torque(int joint, double torque_Nm);
  /// Puts everything at rest in the given pose: angles, zero velocities, activations as given (empty: zero), tissue in
  /// static equilibrium. Refreshes the stiffness of all muscles. Returns false when the static solve did not converge;
  /// and false with nothing changed when the angles are not one finite number a joint. Excitations become the
  /// activations.
  bool settle(std::span<const double> joint_angles_rad, std::span<const double> activations);
  /// Back to the file pose, everything at rest and inactive, so that the settle() that has to follow does not depend on
  /// what went before. Time, excitations, locks, gravity and external torques stay as they are.
  void restart();

  /// One step of dt. `tools` are the newest states of the tools; their springs enter the solve implicitly. A step that
  /// fails is repeated in shorter parts; where these fail too, everything stops in the last usable pose.
  void step(std::span<const messages::ToolState> tools);

  // ---- output
  double time_s() const;  // steps times dt_s since construction; neither settle() nor restart() sets it back
  double activation(int muscle) const;  // 0 .. 1, after the last step or settle
  double excitation(int muscle) const;  // 0 .. 1, as set
  int muscle_count() const;             // as in the specimen
  /// Isometric force of the muscle's tissue, half active at the file pose, over that of its line: 1 within 5 % for a
  /// mesh that can stand for the line, NaN for one that finds no rest; 1 for a muscle without tissue.
  double pull_over_line(int muscle) const;
  /// How its fibres were fitted to its line, for the specimen to carry along; none for a muscle without tissue, and for
  /// one of springs.
  std::optional<anatomy::FibreFit> fibre_fit(int muscle) const;
  /// Not solved for in the last step, since nothing moved it (limb/sleep.h).
  bool asleep(int muscle) const;
  /// Tension that the muscle hands to its tendon; of a Rigid muscle what its line would.
  double muscle_force_N(int muscle) const;
  /// Torque of one muscle about a joint, positive flexes [N m]; of the last step or settle.
  double muscle_torque_Nm(int muscle, int joint) const;
  /// What the muscle does to the joint now: torque of the last step or settle, terms of its line in the present pose.
  MuscleAtJoint muscle_at_joint(int muscle, int joint) const;
  /// Of the last step or settle; stiffness as of the last refresh, contact's part as of the last settle.
  JointReadout joint(int joint) const;
  Pose body_pose(int body) const;  // X_WL: maps rest position to now
  /// Vertices of the muscle's skin, in the mesh's order; valid until the next step, settle or destruction.
  std::span<const Vec3> skin_world_m(int muscle) const;
  /// Three numbers a node of the muscle's mesh, in its order: x, y, z in W. The corner nodes come first, as in the
  /// specimen; mid-sides of the solver's own may follow. Valid until the next step, settle or destruction.
  std::span<const double> nodes_world_m(int muscle) const;
  /// Likewise. Zero for a muscle that is not solved for: a shape on its bones, or asleep.
  std::span<const double> node_velocities_world_m_s(int muscle) const;
  /// Points of the muscle's line from origin to insertion, those round wraps included (line_points_W).
  std::vector<Vec3> line_world_m(int muscle) const;
  double contact_force_N(int muscle) const;        // sum of the contact forces on the muscle's surface
  double contact_depth_m(int muscle) const;        // how far it overlaps most, over what overlaps at the file pose
  double smallest_volume_ratio(int muscle) const;  // smallest J over the integration points
  /// The first muscle whose line cannot clear one of its wraps in this pose, -1 where all can. Such a line is led round
  /// on the surface as if its end lay there: its moment arm has no step, but is not a muscle's.
  int stuck_line() const;
  double volume_ratio(int muscle) const;  // volume of the whole muscle over that at rest
  /// Largest out-of-balance share of a muscle after the last step: forces that nothing balances over the size of all.
  double residual_share() const;
  bool particle_lost() const;  // it flew away (Tether::lost)
  /// Equal for equal bits of everything that moves (hash_of_state, and the particle of a tether).
  std::uint64_t state_hash() const;
  int failed_steps() const;  // that had to be repeated in shorter parts, since construction

  /// The surface near the tool, its compliance at the contact, the line and the bone nearest to (or in) the hand, the
  /// joint. `index`: the tool's place among those of the last step; what the others hold and press is part of what
  /// this one feels. The joint is the first that may rotate. With a tether everything but the tether is empty. Leaves
  /// `reported` as it is.
  void write_local_model(const messages::ToolState& tool, messages::LocalModel& model, int index = 0) const;
  /// Fills in place; the order is that of the specimen.
  void write_frame(messages::SceneFrame& frame) const;  // everything but tools and rates
  /// A muscle's tets one by one, and what they are made of and hang on; slow, for files (tissue_snapshot.h).
  TissueSnapshot tissue(int muscle) const;
  TissueMechanics mechanics(int muscle) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace myotact::simulation
