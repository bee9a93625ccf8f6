#pragma once

#include "simulation/limb/limb.h"

namespace myotact::simulation {

/// Muscles that nothing moves sleep: a step does not solve for their nodes. To the joints such a muscle is what its
/// static tangent says, a linear load about a pose of the joints that strain it, which is made anew as these go on; its
/// nodes follow the joints by the same tangent, and ride on the body that carries the whole of it.
///
///   awake --still, after a refresh of its stiffness--> asleep --.
///     ^                                                  |  ^   | its joints have gone on: a static step
///     '--a tool, its activation, a joint that shakes it--'  '---'
///
/// No muscle sleeps in a limb whose muscles touch: a neighbour that moves would have to wake it.

/// Nothing disturbs the muscle and its nodes hardly move but with the joints. Right after a refresh of its stiffness
/// (settle.h), which says how they follow; between steps, of dt. `excitation`: what its activation tends to.
bool may_sleep(const Limb& limb, int muscle, double excitation, double dt_s);

/// Whether a muscle that falls asleep is in equilibrium to the digits that settle() goes for.
enum class AfterSettle { No, Yes };

/// Puts a muscle that may sleep to sleep where it is, still right after that refresh, whose system it takes over.
void fall_asleep(Limb& limb, int muscle, AfterSettle after_settle);

/// Wakes whom the springs of the coming step pull at, whose activation is no longer that of its sleep, whom a joint
/// shakes, and who damps a joint. Between steps, of dt.
void wake_disturbed(Limb& limb, double dt_s);

/// Wakes whom a settle to these angles and activations, one a muscle, would change.
void wake_unsettled(Limb& limb, const Eigen::VectorXd& angles_rad, const Eigen::VectorXd& activations);

/// Wakes all muscles, at rest where they are.
void wake_all(Limb& limb);

/// What the sleeping muscles do to the joints in the present pose, at the end of a step by `rule`, into their systems.
void evaluate_sleepers(Limb& limb, const TimeRule& rule);

/// A sleeping muscle whose joints have gone on so that its stiffness is no longer what it is told to be.
bool is_stale(const Limb& limb, int muscle);

/// Puts the nodes of the sleeping muscles where the present pose has them, unless that is too near to be seen or felt.
/// Those whose joints have gone too far for their linear load get a new one, and with it a new stiffness; so does
/// `renewed`, where it sleeps (-1: none).
void place_sleepers(Limb& limb, int renewed, WorkerPool& workers);

}  // namespace myotact::simulation
