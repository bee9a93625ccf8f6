#include "simulation/linear/block_matrix.h"

#include <algorithm>
#include <set>

namespace myotact::simulation {

BlockMatrix::BlockMatrix(int nodes, std::span<const std::vector<int>> cliques) {
  std::vector<std::set<int>> rows(static_cast<std::size_t>(nodes));  // of each column, row >= column
  for (int node = 0; node < nodes; ++node) rows[static_cast<std::size_t>(node)].insert(node);
  for (const std::vector<int>& clique : cliques) {
    for (int column : clique) {
      for (int row : clique) {
        if (column >= 0 && row >= column) rows[static_cast<std::size_t>(column)].insert(row);
      }
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < nodes; ++column) {
    for (int row : rows[static_cast<std::size_t>(column)]) {
      for (int k = 0; k < 9; ++k) entries.emplace_back(3 * row + k % 3, 3 * column + k / 3, 0.0);
    }
  }
  matrix_.resize(3 * nodes, 3 * nodes);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  matrix_.makeCompressed();
}

BlockSlot BlockMatrix::slot(int row, int column) const {
  const int* first = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[3 * column];
  const int* last = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[3 * column + 1];
  const int* found = std::lower_bound(first, last, 3 * row);
  if (found == last || *found != 3 * row) return {};
  return {static_cast<int>(found - matrix_.innerIndexPtr()), static_cast<int>(last - first)};
}

void BlockMatrix::set_zero() {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
}

void BlockMatrix::add(int row, int column, const Mat3& block) {
  const bool stored = row >= column;
  const BlockSlot where = stored ? slot(row, column) : slot(column, row);
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) values()[where.base + j * where.stride + i] += stored ? block(i, j) : block(j, i);
  }
}

void BlockMatrix::add_diagonal(int node, double value) {
  const BlockSlot where = slot(node, node);
  for (int i = 0; i < 3; ++i) values()[where.base + i * where.stride + i] += value;
}

}  // namespace myotact::simulation
