#include "measure/validation/box_mesh.h"

#include <random>

namespace myotact::measure {
namespace {

constexpr std::array<std::array<std::size_t, 3>, 6> kOrders{
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

/// The paths along the axes in every order, from a corner of the cell to the opposite one, are its tets. In every
/// second cell along an axis they run the other way.
void add_cell(const Box& box, const std::array<int, 3>& cell, geometry::TetMesh& mesh) {
  std::array<int, 3> first{}, way{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int odd = box.mirrored ? cell[axis] % 2 : 0;
    first[axis] = cell[axis] + odd;
    way[axis] = 1 - 2 * odd;
  }
  const auto node = [&](const std::array<int, 3>& at) {
    return at[0] + (box.cells[0] + 1) * (at[1] + (box.cells[1] + 1) * at[2]);
  };
  for (const auto& order : kOrders) {
    std::array<int, 3> at = first;
    std::array<int, 4> tet{node(at), 0, 0, 0};
    for (std::size_t step = 0; step < 3; ++step) {
      at[order[step]] += way[order[step]];
      tet[step + 1] = node(at);
    }
    mesh.corners.push_back(tet);
    if (geometry::corner_volume_m3(mesh, mesh.corners.size() - 1) < 0.0) {
      std::swap(mesh.corners.back()[2], mesh.corners.back()[3]);
    }
  }
}

}  // namespace

geometry::TetMesh make_box(const Box& box) {
  geometry::TetMesh mesh;
  const Vec3 cell_m(box.size_m.x() / box.cells[0], box.size_m.y() / box.cells[1], box.size_m.z() / box.cells[2]);
  for (int k = 0; k <= box.cells[2]; ++k) {
    for (int j = 0; j <= box.cells[1]; ++j) {
      for (int i = 0; i <= box.cells[0]; ++i) mesh.nodes_m.emplace_back(Vec3(i, j, k).cwiseProduct(cell_m));
    }
  }
  for (int k = 0; k < box.cells[2]; ++k) {
    for (int j = 0; j < box.cells[1]; ++j) {
      for (int i = 0; i < box.cells[0]; ++i) add_cell(box, {i, j, k}, mesh);
    }
  }
  return mesh;
}

std::vector<int> cells_of_box(const geometry::TetMesh& mesh) {
  std::vector<int> cells;
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) cells.push_back(static_cast<int>(t / kOrders.size()));
  return cells;
}

void shake_inside(const Box& box, double share, geometry::TetMesh& mesh) {
  std::mt19937 random(11);
  // The standard's distributions differ from library to library; this is the same everywhere.
  const auto uniform = [&random] { return 2.0 * (static_cast<double>(random()) / 4294967295.0) - 1.0; };
  for (Vec3& x : mesh.nodes_m) {
    const Vec3 place = x.cwiseQuotient(box.size_m);
    if (place.minCoeff() < 1e-9 || place.maxCoeff() > 1.0 - 1e-9) continue;
    for (int axis = 0; axis < 3; ++axis) {
      x[axis] += share * uniform() * box.size_m[axis] / box.cells[static_cast<std::size_t>(axis)];
    }
  }
}

}  // namespace myotact::measure
