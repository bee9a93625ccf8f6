#include "geometry/box_mesh.h"

#include <utility>

namespace myotact::geometry {

namespace {

/// Orders in which a path along the cell's edges can take the three axes, from one end of a diagonal to the other. Each
/// path's four corners are a tet.
constexpr std::array<std::array<std::size_t, 3>, 6> kPaths = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

using Cell = std::array<int, 3>;

int node_of(const Cell& place, const Cell& cells) {
  return (place[0] * (cells[1] + 1) + place[1]) * (cells[2] + 1) + place[2];
}

void add_nodes(const Vec3& size_m, const Cell& cells, TetMesh& mesh) {
  const Eigen::Array3d count(cells[0], cells[1], cells[2]);
  for (int i = 0; i <= cells[0]; ++i) {
    for (int j = 0; j <= cells[1]; ++j) {
      for (int k = 0; k <= cells[2]; ++k) {
        mesh.nodes_m.emplace_back(size_m.array() * Eigen::Array3d(i, j, k) / count);
      }
    }
  }
}

/// The diagonal starts at the corner with even indices: that is what mirrors neighbours.
void add_cell(const Cell& cell, const Cell& cells, BoxCells kind, TetMesh& mesh) {
  Cell start = cell;
  Cell step{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool mirrored = kind == BoxCells::Mirrored && cell[axis] % 2 != 0;
    start[axis] += mirrored ? 1 : 0;
    step[axis] = mirrored ? -1 : 1;
  }
  for (const auto& path : kPaths) {
    Cell place = start;
    std::array<int, 4> corners{node_of(place, cells)};
    for (std::size_t k = 0; k < 3; ++k) {
      place[path[k]] += step[path[k]];
      corners[k + 1] = node_of(place, cells);
    }
    mesh.corners.push_back(corners);
    if (corner_volume_m3(mesh, mesh.corners.size() - 1) < 0.0)
      std::swap(mesh.corners.back()[2], mesh.corners.back()[3]);
  }
}

}  // namespace

TetMesh make_box_mesh(const Vec3& size_m, const std::array<int, 3>& cells, BoxCells kind) {
  TetMesh mesh;
  add_nodes(size_m, cells, mesh);
  for (int i = 0; i < cells[0]; ++i) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int k = 0; k < cells[2]; ++k) add_cell({i, j, k}, cells, kind, mesh);
    }
  }
  return mesh;
}

}  // namespace myotact::geometry
