#pragma once

#include "simulation/linear/block_factor.h"
#include "simulation/solid/static_solve.h"
#include "simulation/time_rule.h"

namespace myotact::simulation {

/// How SolidMotion steps.
struct MotionOptions {
  double dt_s = 0.01;        // > 0
  bool second_order = true;  // BDF2, its first step by backward Euler; else always backward Euler
  int newton_steps = 1;      // of a time step
  /// Factors in single precision: a third faster, Newton directions right to about 1e-4.
  bool single_precision = false;
};

/// A solid in motion under constant loads, one implicit step at a time. Each step starts at the last positions.
class SolidMotion {
 public:
  /// Starts at rest in the rest position, held components displaced. The solid must outlive this; the loads are copied.
  SolidMotion(const Solid& solid, const SolidLoads& loads, const MotionOptions& options);

  /// Positions and velocities, 3 numbers a node; held components are taken from the loads and do not move.
  /// The next step is a first one (backward Euler).
  void set_state(const Eigen::VectorXd& position_m, const Eigen::VectorXd& velocity_m_s);
  /// 0 .. 1; from the next step on.
  void set_activation(double activation) {
    loads_.activation = activation;
    known_ = Solid::Tangent::None;
  }
  /// Returns false, and keeps the last state, when the step cannot be solved.
  bool step();

  /// After the last good step, or as set; 3 numbers a node.
  const Eigen::VectorXd& position_m() const { return now_.position_m; }
  const Eigen::VectorXd& velocity_m_s() const { return now_.velocity_m_s; }
  double residual_share() const { return residual_share_; }  // after the last step's last Newton step
  double smallest_J() const { return elastic_.smallest_J; }  // over the integration points, in the place seen last
  double kinetic_energy_J() const;                           // of the lumped masses

 private:
  /// One instant, 3 numbers a node.
  struct Instant {
    Eigen::VectorXd position_m, velocity_m_s;
  };
  bool newton_step(const TimeRule& rule, Instant& next);
  bool find_direction(const TimeRule& rule, Instant& next, Eigen::VectorXd& direction);
  bool solve(Eigen::VectorXd& direction);
  /// Elastic forces and tangent at a place; what is known of it stays.
  void look(const Eigen::VectorXd& position_m, Solid::Tangent tangent);
  /// Forces at `next` with inertia, held components dropped.
  void balance(const TimeRule& rule, Instant& next);

  const Solid& solid_;
  SolidLoads loads_;
  MotionOptions options_;
  HeldSystem system_;
  ExactBlockFactor exact_;
  BlockFactor single_;
  Solid::Evaluation elastic_;  // at known_m_
  Solid::Tangent known_ = Solid::Tangent::None;
  Eigen::VectorXd known_m_;
  Eigen::VectorXd residual_N_;
  BlockMatrix matrix_;
  Instant now_, before_;
  bool has_history_ = false;
  double residual_share_ = 0.0;
};

}  // namespace myotact::simulation
