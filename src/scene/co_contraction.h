#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// Static torque of every muscle about one joint, with the joint held at one angle and the driven muscles at rising
/// levels. With the joint held the muscles do not act on each other, so that a balance can be found from the table
/// alone.
struct TorqueTable {
  std::vector<double> levels;                  // activations, rising from 0 to 1
  std::vector<std::vector<double>> torque_Nm;  // muscles x levels, positive flexes; constant for those not driven

  std::optional<double> unsettled_level = {};  // lowest level at which the tissue found no equilibrium

  /// Linear between levels; `activation` is clamped to 0 .. 1.
  double torque(int muscle, double activation) const;
};

/// The co-contraction of any joint of the scene's specimen: the scene's own where it is of that joint, else the whole
/// groups of the joint, balanced. Throws Error Usage that names what `joint_key` may be.
CoContraction co_contraction_of(const Scene& scene, const std::string& joint_key);

/// Settles the simulation with the co-contraction's muscles at each level in order, all others as the scene states.
/// Leaves it settled at the scene's own activations. Where the tissue finds no equilibrium, the torques are those of
/// its best state.
TorqueTable measure_torques(const Scene& scene, simulation::Simulation& simulation, std::span<const double> angles_rad);

struct Balance {
  double flexors = 0.0;    // activation of every driven flexor
  double extensors = 0.0;  // activation of every driven extensor
  bool held = false;       // the wanted torque is reached
};

/// Activations at which the net muscle torque is `wanted_Nm`: the weaker side (by its torque at full activation) works
/// at `set.common`, the other side is solved for. Where the stronger side's passive pull alone is too much, it gets 0
/// and the weaker side is raised. `activations` are those of the muscles that are not driven. `set.difference` is added
/// to the flexors (positive) or the extensors (negative) afterwards.
Balance balance(const TorqueTable& table, const CoContraction& set, std::span<const double> activations,
                double wanted_Nm = 0.0);

/// Activations of all muscles: those of `activations`, the two driven sides at the levels of the balance.
std::vector<double> driven_activations(const CoContraction& set, const Balance& levels,
                                       std::vector<double> activations);

/// Trims a balance until nothing is left over at the held angle. It is computed from the present torques and the
/// joint's stiffness, so that who pushes the joint aside feels its stiffness and no more: what a push balances is not
/// trimmed.
class PostureTrim {
 public:
  void restart(const simulation::JointReadout& joint);
  /// After a settle at the held angle with the torque asked for last.
  void correct(const simulation::JointReadout& settled);
  /// Call once a step; returns the torque that the muscles should have [N m].
  double update(const simulation::JointReadout& joint, double dt_s);
  double torque_Nm() const { return torque_Nm_; }  // of the last update

 private:
  double held_angle_rad_ = 0.0;
  double torque_Nm_ = 0.0;
  double left_over_Nm_ = 0.0;  // at the held angle, as of the last update
};

}  // namespace myotact::scene
