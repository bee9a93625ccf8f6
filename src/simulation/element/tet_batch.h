#pragma once

#include "simulation/element/tet_kernel.h"
#include "simulation/simd/batch.h"

// The arithmetic of tet_kernel.h for eight tets. Tet is LinearTet or QuadraticTet. No allocation.

namespace myotact::simulation {

/// Of eight tets: shapes at rest, deformed points, and the material's responses there.
using TetShapes = TetShape<Eight>;
template <class Tet>
using PointBatch = std::array<Point<Eight>, Tet::kPoints>;
template <class Tet>
using ResponseBatch = std::array<Response<Eight>, Tet::kPoints>;

/// Points of the tets at these node positions (world). Overwrites, as all but the adding functions do.
template <class Tet>
void deform_batch(const TetShapes& shapes, const TetNodeVectors<Eight, Tet>& position_m, PointBatch<Tet>& points);

/// Forces that hold the tets, from the stresses `responses[p].P`, in the world.
template <class Tet>
void batch_forces(const TetShapes& shapes, const ResponseBatch<Tet>& responses, TetNodeVectors<Eight, Tet>& force_N);

/// Slope of the tets' mean volume ratio against the node positions, times their volume.
template <class Tet>
void batch_volume_slopes(const TetShapes& shapes, const PointBatch<Tet>& points, TetNodeVectors<Eight, Tet>& slope_m2);

/// Slope of the forces against the positions, from the tangents `responses[p].C`. The part that the slope of a mean
/// volume ratio has in it is add_outer_batch()'s.
template <class Tet>
void batch_stiffness(const TetShapes& shapes, const ResponseBatch<Tet>& responses, TetBlocks<Eight, Tet>& blocks_N_m);

/// blocks += scale v_a (x) v_b for the pairs a <= b.
template <class Tet>
void add_outer_batch(const TetNodeVectors<Eight, Tet>& v, const Eight& scale, TetBlocks<Eight, Tet>& blocks);

/// Adds the volume term on the tets' mean ratio and the fluctuation inside them.
void add_mean_volume_batch(const PointBatch<QuadraticTet>& points, const MeanVolume<Eight>& volume,
                           ResponseBatch<QuadraticTet>& responses);

}  // namespace myotact::simulation
