#include "measure/fit/indentation_mesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/at.h"
#include "geometry/box_mesh.h"

namespace myotact::measure {

namespace {

/// Cells of a size of `first` that grow by at most a factor until `length` is filled; their ends from 0 on.
std::vector<double> growing_ends(double first, double length) {
  constexpr double kGrowth = 2.0;
  std::vector<double> sizes;
  double sum = 0.0;
  for (double size = first; sum < length * (1.0 - 1e-9); size *= kGrowth) {
    sizes.push_back(size);
    sum += size;
  }
  std::vector<double> ends = {0.0};
  for (const double size : sizes) ends.push_back(ends.back() + size * length / sum);
  ends.back() = length;
  return ends;
}

/// A square about the middle becomes a circle within the contact and is one again at the sides.
Vec3 rounded(const Vec3& p, double contact_m, double half_m) {
  const double s = std::max(p.x(), p.y());
  if (s == 0.0) return p;
  const double share = s <= contact_m ? (s / contact_m) * (s / contact_m) : (half_m - s) / (half_m - contact_m);
  const double scale = 1.0 + share * (s / std::hypot(p.x(), p.y()) - 1.0);
  return {scale * p.x(), scale * p.y(), p.z()};
}

}  // namespace

geometry::TetMesh indented_mesh(const IndentedBlock& block, double contact_m) {
  const double half_m = 0.5 * block.width_m, inner_m = contact_m / block.cells;
  std::vector<double> sides;
  for (int i = 0; i < block.cells; ++i) sides.push_back(i * inner_m);
  for (const double end : growing_ends(inner_m, half_m - contact_m)) sides.push_back(contact_m + end);
  const std::vector<double> depths = growing_ends(inner_m, block.thickness_m);
  const int across = static_cast<int>(sides.size()) - 1, down = static_cast<int>(depths.size()) - 1;
  geometry::TetMesh mesh =
      geometry::make_box_mesh({static_cast<double>(across), static_cast<double>(across), static_cast<double>(down)},
                              {across, across, down}, geometry::BoxCells::Alike);
  for (Vec3& node : mesh.nodes_m) {
    const auto place = [](double cell) { return at(static_cast<int>(std::lround(cell))); };
    const Vec3 straight(sides[place(node.x())], sides[place(node.y())],
                        block.thickness_m - depths[depths.size() - 1 - place(node.z())]);
    node = rounded(straight, contact_m, half_m);
  }
  return mesh;
}

bool is_pressed(const Vec3& node_m, const IndentedBlock& block, double contact_m) {
  constexpr double kRounding = 1e-9;
  return node_m.z() > block.thickness_m * (1.0 - kRounding) &&
         std::hypot(node_m.x(), node_m.y()) <= contact_m * (1.0 + kRounding);
}

}  // namespace myotact::measure
