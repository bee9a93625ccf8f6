#pragma once

#include "anatomy/specimen.h"
#include "simulation/line/hill_muscle.h"
#include "simulation/line/line_model.h"
#include "simulation/skeleton/skeleton.h"
#include "simulation/time_rule.h"

namespace myotact::simulation {

/// A muscle as one musculotendon unit along its line: what TissueModel::Line has in the place of tets. It takes part in
/// the joints' equations with its torque and tangent alone; the fibres' length is eliminated in hill_muscle.
struct LineTissue {
  anatomy::MuscleLine line;  // a copy
  HillMuscle hill;           // its slack length makes the fibres rest_stretch x lo long at the file pose
  // Fibre length at the iterate of the present step and the two instants before it.
  double fibre_now_m = 0.0, fibre_last_m = 0.0, fibre_before_m = 0.0;
  double length_m = 0.0;  // of the line in the pose evaluated last
  HillForce force;        // of the pose evaluated last
};

/// `skeleton` at the file pose. Throws Error BadData naming the muscle when its fibres are wider than long there, or
/// longer than the line. A tendon shorter than 0.1 mm is taken as rigid, whatever `tendon` is.
LineTissue make_line_tissue(const anatomy::Muscle& muscle, const anatomy::MuscleLine& line, const Skeleton& skeleton,
                            Tendon tendon);

/// What the line does to the joints: residual (minus its torque) and tangent of the joints' equations.
struct LineLoad {
  Eigen::VectorXd residual_Nm;       // one a joint
  Eigen::MatrixXd stiffness_Nm_rad;  // d residual / d angles
};

/// Force and tangent in the skeleton's pose after a step by `rule` (all zero: at rest), at `activation` (0 .. 1).
/// Keeps length, force and fibre length in `tissue`; the history stays.
LineLoad evaluate_line_tissue(const Skeleton& skeleton, const TimeRule& rule, double activation, LineTissue& tissue);

/// What it does at rest at the length evaluated last; damping is the fibres' own.
LineForce resting_force(const LineTissue& tissue, double activation);

/// The present instant becomes the last one.
void push_history(LineTissue& tissue);
/// The present instant is the last one again.
void restore_last(LineTissue& tissue);
/// All instants are the present one, at rest at `activation` and the length evaluated last.
void bring_to_rest(double activation, LineTissue& tissue);

}  // namespace myotact::simulation
