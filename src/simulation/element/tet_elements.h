#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/vector.h"
#include "simulation/element/tet_batch.h"
#include "simulation/linear/block_factor.h"

// Tets, eight at a time, and how they meet the nodes.

namespace myotact::simulation {

/// Where the block of a pair of nodes goes in a BlockMatrix; base -1: nowhere, one of them is no unknown.
struct PairSlot {
  BlockSlot block;
  bool in_order = true;  // a's row, b's column; else swapped
};

/// [pair of nodes a <= b][lane].
template <class Tet>
using TetSlots = std::array<std::array<PairSlot, kBatch>, kPairs<Tet>>;

/// Up to eight tets of one kind and material, and where they meet the nodes.
template <class Tet>
struct TetBatch {
  TetShapes shapes;               // at rest
  int count = 0;                  // tets in use; the other lanes repeat the last one and count for nothing
  std::size_t material = 0;       // of a Solid's list
  std::array<int, kBatch> tet{};  // number of each lane's tet in its mesh
  std::array<std::array<int, Tet::kNodes>, kBatch> nodes{};  // of the mesh, [lane][node]
  TetSlots<Tet> slots{};                                     // in the matrix of all unknowns
};

/// The tets' part of an array of 3 numbers a node of the mesh.
template <class Tet>
void gather(const TetBatch<Tet>& batch, const Eigen::VectorXd& values, TetNodeVectors<Eight, Tet>& gathered) {
  for (std::size_t lane = 0; lane < kBatch; ++lane) {
    for (std::size_t a = 0; a < Tet::kNodes; ++a) {
      const double* from = values.data() + 3 * batch.nodes[lane][a];
      for (std::size_t i = 0; i < 3; ++i) gathered[a][i].lane[lane] = from[i];
    }
  }
}

/// Adds the first batch.count lanes to an array of 3 numbers a node of the mesh.
template <class Tet>
void scatter(const TetBatch<Tet>& batch, const TetNodeVectors<Eight, Tet>& values, Eigen::VectorXd& out) {
  for (std::size_t lane = 0; lane < static_cast<std::size_t>(batch.count); ++lane) {
    for (std::size_t a = 0; a < Tet::kNodes; ++a) {
      double* to = out.data() + 3 * batch.nodes[lane][a];
      for (std::size_t i = 0; i < 3; ++i) to[i] += values[a][i].lane[lane];
    }
  }
}

/// Adds the first `count` lanes of the blocks to the values of the matrix that the slots belong to (Scalar: what these
/// are kept in).
template <class Tet, class Scalar>
void scatter(const TetSlots<Tet>& slots, int count, const TetBlocks<Eight, Tet>& blocks, Scalar* values) {
  for (std::size_t pair = 0; pair < kPairs<Tet>; ++pair) {
    const Matrix3<Eight>& block = blocks[pair];
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(count); ++lane) {
      const PairSlot& slot = slots[pair][lane];
      if (slot.block.base < 0) continue;
      Scalar* first = values + slot.block.base;
      Scalar* second = first + slot.block.stride;
      Scalar* third = second + slot.block.stride;
      const std::size_t down = slot.in_order ? 3 : 1, across = slot.in_order ? 1 : 3;
      for (std::size_t i = 0; i < 3; ++i) {
        first[i] += static_cast<Scalar>(block[i * down].lane[lane]);
        second[i] += static_cast<Scalar>(block[i * down + across].lane[lane]);
        third[i] += static_cast<Scalar>(block[i * down + 2 * across].lane[lane]);
      }
    }
  }
}

/// Puts a tet into a lane; the lanes behind it repeat it until they get one of their own.
template <class Tet>
void set_lane(TetBatch<Tet>& batch, std::size_t lane, int tet, const TetShape<double>& shape,
              const std::array<int, Tet::kNodes>& nodes) {
  for (; lane < kBatch; ++lane) {
    const double* from = reinterpret_cast<const double*>(&shape);
    Eight* to = reinterpret_cast<Eight*>(&batch.shapes);
    for (std::size_t k = 0; k < sizeof(shape) / sizeof(double); ++k) to[k].lane[lane] = from[k];
    batch.tet[lane] = tet;
    batch.nodes[lane] = nodes;
  }
}

/// Slot of the block of nodes a and b, in the pattern's numbering; nowhere when one is below 0.
inline PairSlot pair_slot(const BlockMatrix& pattern, int a, int b) {
  if (a < 0 || b < 0) return {};
  return {pattern.slot(a > b ? a : b, a > b ? b : a), a >= b};
}

/// The same in the places of a factor.
inline PairSlot pair_slot(const BlockFactor& factor, int a, int b) {
  if (a < 0 || b < 0) return {};
  return {factor.slot(a, b), !factor.is_later(b, a)};
}

/// Slots of a tet's pairs a <= b in a BlockMatrix or a BlockFactor; nodes below 0 are no unknowns. Of one lane.
template <class Tet, class Matrix>
void set_slots(const Matrix& matrix, const std::array<int, Tet::kNodes>& nodes, std::size_t lane,
               TetSlots<Tet>& slots) {
  std::size_t pair = 0;
  for (std::size_t a = 0; a < Tet::kNodes; ++a) {
    for (std::size_t b = a; b < Tet::kNodes; ++b, ++pair) slots[pair][lane] = pair_slot(matrix, nodes[a], nodes[b]);
  }
}

/// Slots of all pairs a <= b of a list of nodes, row by row.
template <class Nodes>
std::vector<PairSlot> pair_slots(const BlockMatrix& pattern, const Nodes& nodes) {
  std::vector<PairSlot> slots;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (std::size_t b = a; b < nodes.size(); ++b) slots.push_back(pair_slot(pattern, nodes[a], nodes[b]));
  }
  return slots;
}

/// From the rest positions of the 4 corners (volume > 0, not checked) and the unit direction of the fibres, or zero.
TetShape<double> make_tet_shape(const std::array<Vec3, 4>& corners_m, const Vec3& fibre);

}  // namespace myotact::simulation
