#include "simulation/element/tet_batch.h"

namespace myotact::simulation {

#define MYOTACT_KERNEL [&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline))

template <class Tet>
void deform_batch(const TetShapes& shapes, const TetNodeVectors<Eight, Tet>& position_m, PointBatch<Tet>& points) {
  run_batch(MYOTACT_KERNEL {
    TetShape<Real> shape;
    TetNodeVectors<Real, Tet> position;
    std::array<Point<Real>, Tet::kPoints> out;
    detail::load<Real>(shapes, part, shape);
    detail::load<Real>(position_m, part, position);
    deform_tet<Tet>(shape, position, out);
    detail::store<Real>(out, part, points);
  });
}

namespace {

/// tet_forces() of eight tets; `matrix(p)` is the stress, or what stands in for it, at point p.
template <class Tet, class MatrixAt>
void push_batch(const TetShapes& shapes, const MatrixAt& matrix, TetNodeVectors<Eight, Tet>& to) {
  run_batch(MYOTACT_KERNEL {
    TetShape<Real> shape;
    std::array<Matrix3<Real>, Tet::kPoints> at_points;
    TetNodeVectors<Real, Tet> out;
    detail::load<Real>(shapes, part, shape);
    for (std::size_t p = 0; p < Tet::kPoints; ++p) detail::load<Real>(matrix(p), part, at_points[p]);
    tet_forces<Tet>(shape, at_points, out);
    detail::store<Real>(out, part, to);
  });
}

}  // namespace

template <class Tet>
void batch_forces(const TetShapes& shapes, const ResponseBatch<Tet>& responses, TetNodeVectors<Eight, Tet>& force_N) {
  push_batch<Tet>(
      shapes, [&](std::size_t p) -> const Matrix3<Eight>& { return responses[p].P; }, force_N);
}

template <class Tet>
void batch_volume_slopes(const TetShapes& shapes, const PointBatch<Tet>& points, TetNodeVectors<Eight, Tet>& slope_m2) {
  push_batch<Tet>(
      shapes, [&](std::size_t p) -> const Matrix3<Eight>& { return points[p].cofactor; }, slope_m2);
}

template <class Tet>
void batch_stiffness(const TetShapes& shapes, const ResponseBatch<Tet>& responses, TetBlocks<Eight, Tet>& blocks_N_m) {
  run_batch(MYOTACT_KERNEL {
    TetShape<Real> shape;
    std::array<std::array<Real, kPacked>, Tet::kPoints> C;
    TetBlocks<Real, Tet> out;
    detail::load<Real>(shapes, part, shape);
    for (std::size_t p = 0; p < Tet::kPoints; ++p) detail::load<Real>(responses[p].C, part, C[p]);
    tet_stiffness<Tet>(shape, C, out);
    detail::store<Real>(out, part, blocks_N_m);
  });
}

template <class Tet>
void add_outer_batch(const TetNodeVectors<Eight, Tet>& v, const Eight& scale, TetBlocks<Eight, Tet>& blocks) {
  run_batch(MYOTACT_KERNEL {
    TetNodeVectors<Real, Tet> vector;
    Real factor;
    TetBlocks<Real, Tet> out;
    detail::load<Real>(v, part, vector);
    detail::load<Real>(scale, part, factor);
    detail::load<Real>(blocks, part, out);
    add_outer_blocks<Tet>(vector, factor, out);
    detail::store<Real>(out, part, blocks);
  });
}

void add_mean_volume_batch(const PointBatch<QuadraticTet>& points, const MeanVolume<Eight>& volume,
                           ResponseBatch<QuadraticTet>& responses) {
  run_batch(MYOTACT_KERNEL {
    std::array<Point<Real>, 4> point;
    std::array<Response<Real>, 4> response;
    MeanVolume<Real> mean;
    detail::load<Real>(points, part, point);
    detail::load<Real>(responses, part, response);
    detail::load<Real>(volume, part, mean);
    add_mean_volume(point, mean, response);
    detail::store<Real>(response, part, responses);
  });
}

#undef MYOTACT_KERNEL

#define MYOTACT_INSTANTIATE(Tet)                                                                                 \
  template void deform_batch<Tet>(const TetShapes&, const TetNodeVectors<Eight, Tet>&, PointBatch<Tet>&);        \
  template void batch_forces<Tet>(const TetShapes&, const ResponseBatch<Tet>&, TetNodeVectors<Eight, Tet>&);     \
  template void batch_volume_slopes<Tet>(const TetShapes&, const PointBatch<Tet>&, TetNodeVectors<Eight, Tet>&); \
  template void batch_stiffness<Tet>(const TetShapes&, const ResponseBatch<Tet>&, TetBlocks<Eight, Tet>&);       \
  template void add_outer_batch<Tet>(const TetNodeVectors<Eight, Tet>&, const Eight&, TetBlocks<Eight, Tet>&);

MYOTACT_INSTANTIATE(LinearTet)
MYOTACT_INSTANTIATE(QuadraticTet)

}  // namespace myotact::simulation
