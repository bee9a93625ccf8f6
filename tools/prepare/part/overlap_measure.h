#pragma once

#include "prepare/field/signed_distance.h"

namespace myotact::prepare {

/// How far two bodies reach into each other.
struct OverlapMeasure {
  double volume_m3 = 0.0;  // in both, counted on a lattice
  double depth_m = 0.0;    // deepest lattice point, measured to the nearer of the two surfaces
};

/// Zero when their boxes do not meet. Deterministic: the lattice follows from the boxes.
OverlapMeasure measure_overlap(const SignedDistance& a, const SignedDistance& b);

}  // namespace myotact::prepare
