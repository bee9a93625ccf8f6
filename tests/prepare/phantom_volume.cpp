#include "prepare/phantom_volume.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/at.h"

namespace myotact::testing {

int phantom_label(const Vec3& p) {
  if ((p - Vec3(12, 11, 12)).norm() < 9.0) return kSphere;
  if ((p - Vec3(12, 26, 12)).norm() < 6.0) return kSmallSphere;  // 15 mm away: they touch
  const Vec3 from_bone = p - Vec3(29, 20, 0);
  const double from_axis = std::hypot(from_bone.x(), from_bone.y());
  if (from_axis < 4.5) return kBone;
  // A piece of a torus round the bone, on its far side.
  if (std::hypot(from_axis - 8.0, p.z() - 16.0) < 3.4 && from_bone.y() > -2.0) return kBentMuscle;
  if (p.z() > 33.9 && p.z() < 37.7 && p.x() < 22.0) return kSheet;  // two steps of 1.9 mm
  return 0;
}

PhantomGrid reordered(const PhantomGrid& grid, const std::array<int, 3>& order, const std::array<bool, 3>& reverse) {
  PhantomGrid turned = grid;
  for (int a = 0; a < 3; ++a) {
    const int old = order[at(a)];
    turned.counts[at(a)] = grid.counts[at(old)];
    turned.steps_mm.col(a) = grid.steps_mm.col(old);
    if (!reverse[at(a)]) continue;
    turned.origin_mm += (grid.counts[at(old)] - 1) * grid.steps_mm.col(old);
    turned.steps_mm.col(a) *= -1.0;
  }
  return turned;
}

std::vector<PhantomGrid> all_orientations(const PhantomGrid& grid) {
  std::vector<PhantomGrid> all;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (unsigned int bits = 0; bits < 8; ++bits) {
      all.push_back(reordered(grid, order, {(bits & 1U) != 0, (bits & 2U) != 0, (bits & 4U) != 0}));
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

PhantomGrid oblique_grid() {
  PhantomGrid grid;
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  grid.steps_mm = turn * Vec3(1.3, 1.9, 3.1).asDiagonal();
  grid.counts = {28, 21, 12};
  grid.origin_mm = Vec3(20, 20, 20) - grid.steps_mm * Vec3(13.5, 10, 5.5);
  return grid;
}

std::vector<int> phantom_labels(const PhantomGrid& grid) {
  std::vector<int> labels;
  for (int k = 0; k < grid.counts[2]; ++k) {
    for (int j = 0; j < grid.counts[1]; ++j) {
      for (int i = 0; i < grid.counts[0]; ++i) labels.push_back(phantom_label(grid.place_mm(i, j, k)));
    }
  }
  return labels;
}

std::string phantom_difference(const prepare::LabelVolume& volume, int layer, int scale) {
  const prepare::Lattice& lattice = volume.lattice;
  const prepare::Labels& labels = volume.layers[at(layer)];
  if (labels.size() != lattice.size()) return "other number of points";
  const std::size_t nx = at(lattice.counts[0]), ny = at(lattice.counts[1]);
  std::size_t parts = 0;
  for (std::size_t point = 0; point < labels.size(); ++point) {
    const std::size_t i = point % nx, j = point / nx % ny, k = point / nx / ny;
    const Vec3 index(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
    const Vec3 specimen_mm = 1e3 * (lattice.origin_m + lattice.steps_m * index);
    // Cranial is superior, left is left, up is posterior.
    const int wanted = scale * phantom_label({specimen_mm.y(), specimen_mm.z(), specimen_mm.x()});
    if (labels[point] != wanted) {
      return fmt::format("point ({}, {}, {}): {} instead of {}", i, j, k, labels[point], wanted);
    }
    parts += wanted != 0 ? 1 : 0;
  }
  return parts > 0 ? "" : "no part";
}

}  // namespace myotact::testing
