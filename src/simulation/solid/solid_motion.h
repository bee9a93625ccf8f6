#pragma once

#include "simulation/solid/static_solve.h"
#include "simulation/time_rule.h"

namespace myotact::simulation {

struct MotionOptions {
  double dt_s = 0.01;
  bool second_order = true;  // BDF2, its first step by backward Euler; else always backward Euler
  int newton_steps = 1;      // of a time step
};

/// A solid in motion under constant loads, one implicit step at a time. Each step starts at the last positions.
class SolidMotion {
 public:
  SolidMotion(const Solid& solid, const SolidLoads& loads, const MotionOptions& options);

  /// Positions and velocities, 3 numbers a node; held components are taken from the loads.
  void set_state(const Eigen::VectorXd& position_m, const Eigen::VectorXd& velocity_m_s);
  void set_activation(double activation) { loads_.activation = activation; }
  /// Returns false, and keeps the last state, when the step cannot be solved.
  bool step();

  const Eigen::VectorXd& position_m() const { return now_.position_m; }
  const Eigen::VectorXd& velocity_m_s() const { return now_.velocity_m_s; }
  double residual_share() const { return residual_share_; }  // after the last step's last Newton step
  double smallest_J() const { return evaluation_.smallest_J; }
  double kinetic_energy_J() const;

 private:
  struct Instant {
    Eigen::VectorXd position_m, velocity_m_s;
  };
  bool newton_step(const TimeRule& rule, Instant& next);
  bool find_direction(const TimeRule& rule, Instant& next, Eigen::VectorXd& direction);
  /// Forces at `next` with inertia, held components dropped.
  void look(const TimeRule& rule, Solid::Tangent tangent, Instant& next);
  void add_inertia(const TimeRule& rule, bool tangent, Instant& next);

  const Solid& solid_;
  SolidLoads loads_;
  MotionOptions options_;
  HeldSystem system_;
  Solid::Evaluation evaluation_;
  Instant now_, before_;
  bool has_history_ = false;
  double residual_share_ = 0.0;
};

}  // namespace myotact::simulation
