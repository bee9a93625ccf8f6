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
#include "simulation/hill_muscle.h"
#include "simulation/tether.h"
#include "simulation/tissue_model.h"

namespace myotact::simulation {

struct SimulationSettings {
  double dt_s = 0.01;
  Vec3 gravity_m_s2 = Vec3::Zero();
  int workers = 2;                  // threads of a step, the caller's included; the result does not depend on it
  std::vector<TissueModel> tissue;  // one a muscle; empty: all Fem
  Tendon tendon = Tendon::Elastic;  // of the Line muscles
  bool contact = true;  // muscles touch bones and each other; false is for speed where touch is all that counts
  std::optional<TetherSettings> tether = {};  // then nothing else is felt
};

/// Joint stiffness K = -d(net torque)/dq at held activations, and what it is made of. All about the joint's axis.
struct JointReadout {
  double angle_rad = 0.0;
  double velocity_rad_s = 0.0;
  double net_torque_Nm = 0.0;         // of all muscles on the joint, positive flexes
  double own_torque_Nm = 0.0;         // of the joint's spring and stop and the weight of the bones, positive flexes
  double stiffness_Nm_rad = 0.0;      // Schur complement of the quasi-static system, passive joint included
  double line_muscle_Nm_rad = 0.0;    // sum r^2 k of the muscle lines
  double line_geometry_Nm_rad = 0.0;  // -sum (dr/dq) F of the muscle lines
  double contact_Nm_rad = 0.0;  // of the stiffness: lost if contact forces stayed as they are while the joint turns
  double passive_Nm_rad = 0.0;  // the joint's own
  double inertia_kg_m2 = 0.0;
  double joint_damping_Nms_rad = 0.0;  // the joint's own
  double damping_Nms_rad = 0.0;        // of the joint itself and the muscle lines' fibres, sum r^2 b
  bool preview = false;  // a mass-spring muscle spans the joint: torque and stiffness are no more than a preview
};

/// One muscle's part in a joint's readout.
struct MuscleAtJoint {
  double torque_Nm = 0.0;             // positive flexes
  double stiffness_Nm_rad = 0.0;      // of the quasi-static tissue, as of the last refresh
  double contact_Nm_rad = 0.0;        // of that stiffness, as of the last settle
  double line_muscle_Nm_rad = 0.0;    // r^2 k of its line
  double line_geometry_Nm_rad = 0.0;  // -(dr/dq) F of its line
  double line_damping_Nms_rad = 0.0;  // r^2 b of its line's fibres
  double lever_m = 0.0;               // r of its line, positive flexes
  double lever_slope_m_rad = 0.0;     // dr/dq
  std::optional<HillForce> unit;      // of a Line muscle: fibres and tendon at rest at the present length
};

/// Soft muscles on a skeleton, advanced by a fixed implicit step. Single caller; makes its own workers.
class Simulation {
 public:
  /// Builds meshes, factors' patterns, embeddings. Throws Error BadData when the specimen cannot be simulated.
  Simulation(const anatomy::Specimen& specimen, const SimulationSettings& settings);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  // ---- input, between steps
  void set_excitation(int muscle, double excitation);  // 0 .. 1, drives the activation's first-order lag
  void set_joint_locked(int joint, bool locked);
  void set_gravity(const Vec3& gravity_m_s2);
  /// External torque about a joint, positive flexes [N m]; held until set again.
  void set_joint_torque(int joint, double torque_Nm);
  /// Puts everything at rest in the given pose: angles, zero velocities, activations as given (empty: zero), tissue in
  /// static equilibrium. Refreshes the stiffness of all muscles. Returns false when the static solve did not converge.
  bool settle(std::span<const double> joint_angles_rad, std::span<const double> activations);
  /// Back to the file pose, everything at rest and inactive, so that the settle() that has to follow does not depend on
  /// what went before.
  void restart();

  /// One step of dt. `tools` are the newest states of the tools; their springs enter the solve implicitly.
  void step(std::span<const messages::ToolState> tools);

  // ---- output
  double time_s() const;
  double activation(int muscle) const;
  double excitation(int muscle) const;
  int muscle_count() const;
  double muscle_force_N(int muscle) const;  // tension that the muscle hands to its tendon
  /// Torque of one muscle about a joint, positive flexes [N m]; of the last step or settle.
  double muscle_torque_Nm(int muscle, int joint) const;
  MuscleAtJoint muscle_at_joint(int muscle, int joint) const;
  /// Of the last step or settle; stiffness as of the last refresh, contact's part as of the last settle.
  JointReadout joint(int joint) const;
  Pose body_pose(int body) const;  // X_WL: maps rest position to now
  std::span<const Vec3> skin_world_m(int muscle) const;
  std::vector<Vec3> line_world_m(int muscle) const;
  double contact_force_N(int muscle) const;        // sum of the contact forces on the muscle's surface
  double contact_depth_m(int muscle) const;        // how far it overlaps most, over what overlaps at the file pose
  double smallest_volume_ratio(int muscle) const;  // smallest J over the integration points
  /// The first muscle whose line cannot clear one of its wraps in this pose, -1 where all can. Such a line is led round
  /// on the surface as if its end lay there: its lever has no step, but is not a muscle's.
  int stuck_line() const;
  double volume_ratio(int muscle) const;  // volume of the whole muscle over that at rest
  /// Largest out-of-balance share of a muscle after the last step: forces that nothing balances over the size of all.
  double residual_share() const;
  bool particle_lost() const;  // it flew away (Tether::lost)
  std::uint64_t state_hash() const;
  int failed_steps() const;  // that had to be repeated in shorter parts, since construction

  /// The surface near the tool, its compliance at the contact, the line and the bone nearest to (or in) the hand, the
  /// joint. `index`: the tool's place among those of the last step; what the others hold and press is part of what
  /// this one feels.
  void write_local_model(const messages::ToolState& tool, messages::LocalModel& model, int index = 0) const;
  void write_frame(messages::SceneFrame& frame) const;  // everything but tools and rates

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace myotact::simulation
