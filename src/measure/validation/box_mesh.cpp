#include "measure/validation/box_mesh.h"

#include <random>

#include "geometry/box_mesh.h"

namespace myotact::measure {
geometry::TetMesh make_box(const Box& box) {
  return geometry::make_box_mesh(box.size_m, box.cells,
                                 box.mirrored ? geometry::BoxCells::Mirrored : geometry::BoxCells::Alike);
}

std::vector<int> cells_of_box(const geometry::TetMesh& mesh) {
  std::vector<int> cells;
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) cells.push_back(static_cast<int>(t / geometry::kTetsOfBoxCell));
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
