#pragma once

#include "simulation/muscle/tissue_pass.h"

namespace myotact::simulation {

// A muscle's fibres run through the whole belly and hold one number of sarcomeres each, so their force follows from the
// length of the whole fibre. Taken point by point instead, the falling limb of the force-length curve lets single
// points snap to twice their length while their neighbours shorten, which no muscle does at this scale. Therefore
//
//   active stress = a peak [ fL(mean n) + h (n - mean n) ] + damping,      h > 0
//
// the muscle's mean length decides the force, and a point that differs from the mean is drawn back as on the rising
// limb. The second term adds nothing to the muscle's force. Passive stress is local.

/// h: slope of the force-length curve at n = 0.8, the middle of its rising limb.
inline constexpr double kEvenness = 1.0;

/// Mean of the normalised fibre length, weighted by volume times peak stress; rest_stretch without fibres. `stretches`:
/// one an integration point, element by element.
double mean_fibre_length(const MuscleTissue& tissue, const std::vector<double>& stretches);

/// Sum of volume times peak stress over all points, the calibrated scale left out.
double fibre_weight_Nm(const MuscleTissue& tissue);

/// What the stress of every point depends on besides its own stretch. Refers to its arguments.
struct FibreInputs {
  const MuscleTissue& tissue;
  const TissueState& state;
  const TissueLoad& load;
  double mean_length = 0.0;   // normalised, now
  double shared_force = 0.0;  // fL of it
  double damped_force = 0.0;  // fL of the mean length at the last instant, which scales the damping
};
/// What all points share in the present iterate.
FibreInputs fibre_inputs(const MuscleTissue& tissue, const TissueState& state, const TissueLoad& load);

/// Nominal stress of the fibres at a point (force over rest section), and its slope against the point's own stretch
/// with the mean length held.
struct FibreStress {
  double stress_Pa = 0.0;
  double slope_Pa = 0.0;
};
/// Of one point of one element, damping included where the load has it. Zero without fibres (sheath).
FibreStress fibre_stress(const FibreInputs& inputs, std::size_t element, std::size_t point);

/// How the mean length enters the tangent: factor * (gradient of the mean)(gradient of the mean)^T. Negative where
/// the force-length curve is less steep than kEvenness.
double mean_tangent_Nm(const FibreInputs& inputs);

}  // namespace myotact::simulation
