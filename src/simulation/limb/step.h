#pragma once

#include <limits>

#include "simulation/limb/limb.h"
#include "simulation/worker_pool.h"

namespace myotact::simulation {

/// One implicit step of the whole limb.
///
///   start at x_n -> [per muscle: tangent, factor, solve its borders] -> small dense system of joint angles and tool
///   springs -> [per muscle: back-substitute, forces] -> balanced? else once more
///
/// Each muscle is one task; sums over muscles run in their order, so the result does not depend on the workers.
struct StepInput {
  double dt_s = 0.01;                // > 0
  bool second_order_in_time = true;  // false: backward Euler, for the first step and after a failure
};

/// How a step went.
struct StepReport {
  bool sound = true;            // false: the state holds no usable result; go back and take shorter steps
  int iterations = 0;           // Newton steps; one more than were done where they ran out
  int definite_solves = 0;      // muscles whose tangent had to be made definite
  double residual_share = 0.0;  // largest of a muscle, at the end
};

/// Advances `limb.now` from limb.last and limb.before (see push_history). Activations, springs, gravity and torques are
/// as set in the limb. Fills spring forces and compliances, readouts, loads and rates. Where the report is not sound,
/// call restore_last(). Allocates.
StepReport advance(Limb& limb, const StepInput& input, WorkerPool& workers);

/// What relax() is asked for.
struct RelaxInput {
  double share = 1.0;   // largest out-of-balance share of a muscle now
  double time_s = 1e3;  // mass over its square is added to the tangent: short, and the step is
  double farthest_m = std::numeric_limits<double>::infinity();  // that a node may go
};
/// How relax() went.
struct Relaxation {
  bool sound = true;  // false: the place cannot be used
  double part = 1.0;  // of the step that was gone
};
/// One Newton step of all muscles together towards static equilibrium, joints held, rates forgotten. Overwrites the
/// muscles' last positions and velocities.
Relaxation relax(Limb& limb, const RelaxInput& input, WorkerPool& workers);

/// The present instant becomes the last one, and that the one before it. Call before advance().
void push_history(Limb& limb);
/// Undoes a failed advance(): the present instant is the last one again. Activations and the stretch rates of the
/// force-velocity tangent stay.
void restore_last(Limb& limb);

}  // namespace myotact::simulation
