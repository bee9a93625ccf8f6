#pragma once

#include "simulation/element/batch.h"
#include "simulation/element/tet_kernel.h"

// The arithmetic of tet_kernel.h for eight tets. Tet is LinearTet or QuadraticTet. No allocation.

namespace myotact::simulation {

using TetShapes = TetShape<Eight>;
template <class Tet>
using PointBatch = std::array<Point<Eight>, Tet::kPoints>;
template <class Tet>
using ResponseBatch = std::array<Response<Eight>, Tet::kPoints>;

template <class Tet>
void deform_batch(const TetShapes& shapes, const TetNodeVectors<Eight, Tet>& position_m, PointBatch<Tet>& points);

/// Forces that hold the tets, from the stresses `responses[p].P`.
template <class Tet>
void batch_forces(const TetShapes& shapes, const ResponseBatch<Tet>& responses, TetNodeVectors<Eight, Tet>& force_N);

/// Slope of the tets' mean volume ratio against the node positions, times their volume [m^2].
template <class Tet>
void batch_volume_slopes(const TetShapes& shapes, const PointBatch<Tet>& points, TetNodeVectors<Eight, Tet>& slope_m2);

template <class Tet>
void batch_stiffness(const TetShapes& shapes, const ResponseBatch<Tet>& responses, TetBlocks<Eight, Tet>& blocks_N_m);

/// blocks += scale v_a (x) v_b.
template <class Tet>
void add_outer_batch(const TetNodeVectors<Eight, Tet>& v, const Eight& scale, TetBlocks<Eight, Tet>& blocks);

/// Adds the volume term on the tets' mean ratio and the fluctuation inside them.
void add_mean_volume_batch(const PointBatch<QuadraticTet>& points, const MeanVolume<Eight>& volume,
                           ResponseBatch<QuadraticTet>& responses);

}  // namespace myotact::simulation
