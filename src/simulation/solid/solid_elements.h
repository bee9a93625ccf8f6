#pragma once

#include <vector>

#include <Eigen/Core>

#include "simulation/block_matrix.h"
#include "simulation/element/tet_batch.h"

// The tets of a solid, eight at a time, and how they meet the nodes.

namespace myotact::simulation {

/// Where the block of a pair of nodes goes in a BlockMatrix.
struct PairSlot {
  BlockSlot block;
  bool in_order = true;  // a's row, b's column; else the other way round
};

template <class Tet>
struct TetBatch {
  TetShapes shapes;
  int count = 0;  // tets in use; the other lanes repeat the last one and count for nothing
  std::size_t material = 0;
  std::array<int, kBatch> tet{};
  std::array<std::array<int, Tet::kNodes>, kBatch> nodes{};
  std::array<std::array<PairSlot, kPairs<Tet>>, kBatch> slots{};
};

template <class Tet>
MYOTACT_INTO_CLONES void gather(const TetBatch<Tet>& batch, const Eigen::VectorXd& values,
                                TetNodeVectors<Eight, Tet>& gathered) {
  for (std::size_t lane = 0; lane < kBatch; ++lane) {
    for (std::size_t a = 0; a < Tet::kNodes; ++a) {
      const double* from = values.data() + 3 * batch.nodes[lane][a];
      for (std::size_t i = 0; i < 3; ++i) gathered[a][i].lane[lane] = from[i];
    }
  }
}

template <class Tet>
void scatter(const TetBatch<Tet>& batch, const TetNodeVectors<Eight, Tet>& values, Eigen::VectorXd& out) {
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(batch.count); ++lane) {
    for (std::size_t a = 0; a < Tet::kNodes; ++a) {
      double* to = out.data() + 3 * batch.nodes[lane][a];
      for (std::size_t i = 0; i < 3; ++i) to[i] += values[a][i].lane[lane];
    }
  }
}

template <class Tet>
void scatter(const TetBatch<Tet>& batch, const TetBlocks<Eight, Tet>& blocks, double* values) {
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(batch.count); ++lane) {
    for (std::size_t pair = 0; pair < kPairs<Tet>; ++pair) {
      const PairSlot& slot = batch.slots[lane][pair];
      const Matrix3<Eight>& block = blocks[pair];
      double* first = values + slot.block.base;
      double* second = first + slot.block.stride;
      double* third = second + slot.block.stride;
      const std::size_t down = slot.in_order ? 3 : 1, across = slot.in_order ? 1 : 3;
      for (std::size_t i = 0; i < 3; ++i) {
        first[i] += block[i * down].lane[lane];
        second[i] += block[i * down + across].lane[lane];
        third[i] += block[i * down + 2 * across].lane[lane];
      }
    }
  }
}

}  // namespace myotact::simulation
