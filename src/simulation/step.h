#pragma once

#include <limits>

#include "simulation/limb.h"
#include "simulation/worker_pool.h"

namespace myotact::simulation {

/// One implicit step of the whole limb.
///
///   start at x_n -> [per muscle: tangent, factor, solve its borders] -> small dense system of joint angles and tool
///   springs -> [per muscle: back-substitute, forces] -> balanced? else once more
///
/// Each muscle is one task; sums over muscles run in their order, so the result does not depend on the workers.
struct StepInput {
  double dt_s = 0.01;
  bool second_order_in_time = true;  // false: backward Euler, for the first step and after a failure
};

struct StepReport {
  bool sound = true;        // false: the state holds no usable result; go back and take shorter steps
  int iterations = 0;       // Newton steps
  int definite_solves = 0;  // muscles whose tangent had to be made definite
  double residual_share = 0.0;
};

/// Advances `limb.now` from limb.last and limb.before (see push_history). Activations, springs, gravity and torques are
/// as set in the limb.
StepReport advance(Limb& limb, const StepInput& input, WorkerPool& workers);

struct RelaxInput {
  double share = 1.0;   // largest out-of-balance share of a muscle now
  double time_s = 1e3;  // mass over its square is added to the tangent: short, and the step is
  double farthest_m = std::numeric_limits<double>::infinity();  // that a node may go
};
struct Relaxation {
  bool sound = true;  // false: the place cannot be used
  double part = 1.0;  // of the step that was gone
};
/// One Newton step of all muscles together towards static equilibrium, joints held, rates forgotten.
Relaxation relax(Limb& limb, const RelaxInput& input, WorkerPool& workers);

/// The present instant becomes the last one. Call before advance().
void push_history(Limb& limb);
/// Undoes a failed advance(): the present instant is the last one again.
void restore_last(Limb& limb);

}  // namespace myotact::simulation
