#pragma once

#include "simulation/element/tet_batch.h"
#include "simulation/material/stable_neo_hookean.h"

namespace myotact::simulation {

/// Where a point of a muscle counts as folding over. Tissue keeps its volume: a point at half of it is none of tissue's
/// states, but an element's near a clamped end that cannot follow what its fibres do. With 0.05 points of the shipped
/// limbs came down to -0.05 at full activation, with this to 0.24; K changes by 0.3 % at most.
inline constexpr double kMuscleFoldedJ = 0.5;

/// What eight quadratic tets of living muscle need: the matrix, with its volume term on the tets' mean volume ratios,
/// and at each point the nominal stress of the fibres (force over rest section) with its slope against the stretch.
struct MuscleBatch {
  const TetShapes& shapes;
  const PointBatch<QuadraticTet>& points;  // deformed
  StableNeoHookean matrix;
  Eight fluctuation_Pa;                                  // c of MeanVolume
  std::array<Eight, QuadraticTet::kPoints> stress_Pa{};  // of the fibres
  std::array<Eight, QuadraticTet::kPoints> slope_Pa{};   // against the stretch
};

/// Forces that hold the deformed tets (slope of their energy), in the world. Overwrites, as the functions below do.
/// Allocates nothing.
void muscle_forces(const MuscleBatch& batch, TetNodeVectors<Eight, QuadraticTet>& force_N);

/// Slope of the forces against the positions. `definite` drops or bounds every term that could make it indefinite: a
/// slower but safe Newton matrix.
void muscle_stiffness(const MuscleBatch& batch, bool definite, TetBlocks<Eight, QuadraticTet>& blocks_N_m);

/// Slope of the integral of the fibres' stretch over the tets' volume against the node positions.
void fibre_stretch_slopes(const TetShapes& shapes, const PointBatch<QuadraticTet>& points,
                          TetNodeVectors<Eight, QuadraticTet>& slope_m2);

}  // namespace myotact::simulation
