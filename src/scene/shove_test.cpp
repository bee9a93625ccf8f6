#include "scene/shove_test.h"

#include <algorithm>
#include <numbers>

namespace myotact::scene {
namespace {

/// When the parts of the test end [s]. The push lasts longer than any tendon needs to settle (0.1 s), its ramps are far
/// slower than the joint swings (0.1 to 0.5 s a period).
constexpr double kRestEnd_s = 0.1, kRampEnd_s = 0.7, kLookFrom_s = 1.3, kHoldEnd_s = 1.5, kBackEnd_s = 2.1;
constexpr double kStrokeFrom_s = 3.0, kStrokeEnd_s = 3.05, kSwingEnd_s = 4.05;

constexpr double kWantedTurn_rad = std::numbers::pi / 180.0;
/// A limp or unstable joint gets the torque of this stiffness [N m/rad].
constexpr double kLeastStiffness_Nm_rad = 0.2;
/// The stroke is shorter than the joint's answer: it takes this many times the push to rotate it as far.
constexpr double kStrokeOverPush = 3.0;

double push_share(double t_s) {
  if (t_s < kRestEnd_s || t_s >= kBackEnd_s) return 0.0;
  if (t_s < kRampEnd_s) return (t_s - kRestEnd_s) / (kRampEnd_s - kRestEnd_s);
  return t_s < kHoldEnd_s ? 1.0 : (kBackEnd_s - t_s) / (kBackEnd_s - kHoldEnd_s);
}

}  // namespace

void ShoveTest::start(int joint, const simulation::Simulation& simulation) {
  record_ = {};
  record_.joint = joint;
  record_.dt_s = dt_s_;
  record_.before = simulation.joint(joint);
  for (int m = 0; m < simulation.muscle_count(); ++m) {
    record_.muscles_before.push_back(simulation.muscle_at_joint(m, joint));
  }
  record_.push_Nm = kWantedTurn_rad * std::max(record_.before.stiffness_Nm_rad, kLeastStiffness_Nm_rad);
  record_.pulse_Nm = kStrokeOverPush * record_.push_Nm;
  record_.pulse_s = kStrokeEnd_s - kStrokeFrom_s;
  rest_rad_ = held_rad_ = 0.0;
  rest_steps_ = held_steps_ = 0;
  step_ = 0;
}

double ShoveTest::next_torque_Nm(const simulation::Simulation& simulation) {
  const double t_s = (step_++ + 0.5) * dt_s_;  // the middle of the step, so that rounding decides nothing
  const double q_rad = simulation.joint(record_.joint).angle_rad;
  if (t_s < kRestEnd_s) {
    rest_rad_ += q_rad;
    ++rest_steps_;
  }
  const double rest_rad = rest_rad_ / std::max(1, rest_steps_);
  if (t_s >= kLookFrom_s && t_s < kHoldEnd_s) {
    held_rad_ += q_rad;
    ++held_steps_;
    record_.pushed_rad = held_rad_ / held_steps_ - rest_rad;
  }
  if (t_s >= kStrokeFrom_s) record_.swing_rad.push_back(q_rad - rest_rad);
  if (t_s >= kSwingEnd_s) {
    finished_ = record_;
    step_ = -1;
  }
  const bool strikes = t_s >= kStrokeFrom_s && t_s < kStrokeEnd_s;
  return push_share(t_s) * record_.push_Nm + (strikes ? record_.pulse_Nm : 0.0);
}

}  // namespace myotact::scene
