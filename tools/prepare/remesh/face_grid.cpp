#include "prepare/remesh/face_grid.h"

#include <algorithm>
#include <cmath>

namespace myotact::prepare {

std::uint64_t FaceGrid::key_of(const Cell& cell) {
  constexpr std::uint64_t kMask = (1U << 21) - 1;  // cells farther apart share a key, which only costs time
  std::uint64_t key = 0;
  for (const int i : cell) key = (key << 21) | (static_cast<std::uint64_t>(static_cast<std::int64_t>(i)) & kMask);
  return key;
}

std::pair<FaceGrid::Cell, FaceGrid::Cell> FaceGrid::cells_of(const Eigen::AlignedBox3d& box) const {
  Cell low{}, high{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    low[k] = static_cast<int>(std::floor(box.min()[axis] / cell_m_));
    high[k] = static_cast<int>(std::floor(box.max()[axis] / cell_m_));
  }
  return {low, high};
}

void FaceGrid::insert(int face, const Corners& corners) {
  if (static_cast<std::size_t>(face) >= entries_.size()) entries_.resize(static_cast<std::size_t>(face) + 1);
  Entry& entry = entries_[static_cast<std::size_t>(face)];
  entry.corners = corners;
  entry.box.setEmpty();
  for (const Vec3& corner : corners) entry.box.extend(corner);
  const auto [low, high] = cells_of(entry.box);
  for (int x = low[0]; x <= high[0]; ++x) {
    for (int y = low[1]; y <= high[1]; ++y) {
      for (int z = low[2]; z <= high[2]; ++z) cells_[key_of({x, y, z})].push_back(face);
    }
  }
}

void FaceGrid::remove(int face) {
  const auto [low, high] = cells_of(entries_[static_cast<std::size_t>(face)].box);
  for (int x = low[0]; x <= high[0]; ++x) {
    for (int y = low[1]; y <= high[1]; ++y) {
      for (int z = low[2]; z <= high[2]; ++z) std::erase(cells_[key_of({x, y, z})], face);
    }
  }
}

}  // namespace myotact::prepare
