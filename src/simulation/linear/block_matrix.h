#pragma once

#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "core/vector.h"

namespace myotact::simulation {

/// Where a 3x3 block lies in the value array: entry (i, j) at base + j * stride + i.
struct BlockSlot {
  int base = -1;   // -1: nowhere
  int stride = 0;  // from column to column
};

/// Symmetric sparse matrix of 3x3 blocks with a fixed pattern. Only blocks with row >= column are stored, the diagonal
/// ones whole.
class BlockMatrix {
 public:
  BlockMatrix() = default;  // no nodes
  /// Every set of nodes in `cliques` is coupled pair by pair; entries below 0 are left out. Values are zero; all
  /// diagonal blocks are stored.
  BlockMatrix(int nodes, std::span<const std::vector<int>> cliques);

  int nodes() const { return static_cast<int>(matrix_.cols() / 3); }  // rows and columns of blocks
  /// Slot of a stored block (row >= column). Base -1 when the pattern does not have it.
  BlockSlot slot(int row, int column) const;
  void set_zero();                                 // the pattern stays
  double* values() { return matrix_.valuePtr(); }  // lower()'s; slots refer to them
  /// Adds a block; both orders of row and column name the same stored block, which the pattern must have.
  void add(int row, int column, const Mat3& block);
  /// Adds value times the unit matrix to the node's diagonal block.
  void add_diagonal(int node, double value);
  /// As a scalar matrix whose lower triangle holds the values; blocks on the diagonal are whole.
  const Eigen::SparseMatrix<double>& lower() const { return matrix_; }

 private:
  Eigen::SparseMatrix<double> matrix_;
};

}  // namespace myotact::simulation
