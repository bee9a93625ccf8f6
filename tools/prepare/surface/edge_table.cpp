#include "prepare/surface/edge_table.h"

#include <algorithm>
#include <numeric>

namespace myotact::prepare {

EdgeTable::EdgeTable(const geometry::TriangleMesh& mesh) : first_(mesh.positions_m.size() + 1, 0) {
  for (const auto& [a, b, c] : mesh.triangles) {
    ++first_[at(std::min(a, b)) + 1];
    ++first_[at(std::min(b, c)) + 1];
    ++first_[at(std::min(c, a)) + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  uses_.resize(3 * mesh.triangles.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  const int sides = static_cast<int>(uses_.size());
  for (int side = 0; side < sides; ++side) {
    const auto [low, high] = std::minmax({tail_of(mesh, side), head_of(mesh, side)});
    uses_[next[at(low)]++] = {high, side};
  }
  for (std::size_t v = 0; v + 1 < first_.size(); ++v) {
    std::sort(uses_.begin() + static_cast<std::ptrdiff_t>(first_[v]),
              uses_.begin() + static_cast<std::ptrdiff_t>(first_[v + 1]),
              [](const EdgeUse& a, const EdgeUse& b) { return a.high != b.high ? a.high < b.high : a.side < b.side; });
  }
}

std::vector<int> opposite_sides(const geometry::TriangleMesh& mesh) {
  std::vector<int> opposite(3 * mesh.triangles.size(), kOpen);
  EdgeTable(mesh).for_each_edge([&](int, int, std::span<const EdgeUse> uses) {
    if (uses.size() == 2) {
      opposite[at(uses[0].side)] = uses[1].side;
      opposite[at(uses[1].side)] = uses[0].side;
    } else if (uses.size() > 2) {
      for (const EdgeUse& use : uses) opposite[at(use.side)] = kCrowded;
    }
  });
  return opposite;
}

bool is_closed(const geometry::TriangleMesh& mesh) {
  const std::vector<int> opposite = opposite_sides(mesh);
  for (int side = 0; side < static_cast<int>(opposite.size()); ++side) {
    const int other = opposite[at(side)];
    if (other < 0 || tail_of(mesh, side) != head_of(mesh, other)) return false;
  }
  return !opposite.empty();
}

EdgeCounts count_edges(const geometry::TriangleMesh& mesh) {
  EdgeCounts counts;
  EdgeTable(mesh).for_each_edge([&](int low, int high, std::span<const EdgeUse> uses) {
    if (uses.size() > 2) ++counts.crowded;
    if (uses.size() != 1) return;
    ++counts.open;
    counts.open_length += (mesh.positions_m[at(low)] - mesh.positions_m[at(high)]).norm();
  });
  return counts;
}

Groups::Groups(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

int Groups::group_of(int i) {
  while (parent_[at(i)] != i) {
    parent_[at(i)] = parent_[at(parent_[at(i)])];  // shortens the way for the next call
    i = parent_[at(i)];
  }
  return i;
}

void Groups::join(int a, int b) {
  const int first = group_of(a), second = group_of(b);
  parent_[at(std::max(first, second))] = std::min(first, second);
}

}  // namespace myotact::prepare
