#pragma once

#include <vector>

#include "simulation/simulation.h"

namespace myotact::scene {

/// How long a test takes.
inline constexpr double kShoveTest_s = 4.06;

/// What a joint did when it was pushed slowly and then struck. Activations held; the joint at rest before.
struct ShoveRecord {
  int joint = -1;
  double dt_s = 0.0;
  simulation::JointReadout before;  // at rest
  std::vector<simulation::MuscleAtJoint> muscles_before;
  double push_Nm = 0.0;  // slow push, and how far it took the joint from its rest
  double pushed_rad = 0.0;
  double pulse_Nm = 0.0;  // stroke and its duration
  double pulse_s = 0.0;
  std::vector<double> swing_rad;  // from the start of the stroke, one a step, beyond the rest

  /// K as the push has measured it [N m/rad].
  double pushed_stiffness_Nm_rad() const { return push_Nm / pushed_rad; }
};

/// The torque about one joint that measures how stiff it feels:
///
///      push  ____________              stroke
///           /            \             .-.
///   _______/              \____________| |______________ swing, 1 s
///    rest   ramp  hold   ramp   rest
///
/// One call a step; on the simulation's thread.
class ShoveTest {
 public:
  /// `dt_s` of a step.
  explicit ShoveTest(double dt_s) : dt_s_(dt_s) {}

  /// Begins anew. The push is sized to rotate the joint by a degree.
  void start(int joint, const simulation::Simulation& simulation);
  bool under_way() const { return step_ >= 0; }
  int joint() const { return record_.joint; }

  /// Torque of the next step; looks at the joint first.
  double next_torque_Nm(const simulation::Simulation& simulation);

  /// Of the last test that came to its end; joint -1: none has.
  const ShoveRecord& record() const { return finished_; }

 private:
  double dt_s_;
  int step_ = -1;  // of the test under way
  ShoveRecord record_, finished_;
  double rest_rad_ = 0.0, held_rad_ = 0.0;  // sums over the steps that are averaged
  int rest_steps_ = 0, held_steps_ = 0;
};

}  // namespace myotact::scene
