#pragma once

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

/// One static Newton step of all muscles together, joints held, everything at rest. `share`: largest
/// out-of-balance share of a muscle now. Returns the largest out-of-balance
/// share of a muscle after it; infinite when the place cannot be used.
double relax(Limb& limb, double share, WorkerPool& workers);

/// The present instant becomes the last one. Call before advance().
void push_history(Limb& limb);
/// Undoes a failed advance(): the present instant is the last one again.
void restore_last(Limb& limb);

}  // namespace myotact::simulation
