#include "geometry/plain_surfaces.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "core/at.h"

namespace myotact::geometry {

namespace {

/// Adds a grid over the parallelogram at `corner`, outside along u x v. Grids do not share vertices.
void add_grid(TriangleMesh& mesh, const Vec3& corner, const Vec3& u, const Vec3& v, int cells) {
  const int first = static_cast<int>(mesh.positions_m.size());
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) mesh.positions_m.push_back(corner + u * (1.0 * i / cells) + v * (1.0 * j / cells));
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int a = first + j * (cells + 1) + i;
      mesh.triangles.push_back({a, a + 1, a + cells + 2});
      mesh.triangles.push_back({a, a + cells + 2, a + cells + 1});
    }
  }
}

/// Makes one vertex of those that lie within a nanometre of each other.
TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh result;
  std::map<std::array<long, 3>, int> numbers;
  std::vector<int> number_of;
  for (const Vec3& x : mesh.positions_m) {
    const std::array<long, 3> key{std::lround(1e9 * x.x()), std::lround(1e9 * x.y()), std::lround(1e9 * x.z())};
    const auto [found, is_new] = numbers.try_emplace(key, static_cast<int>(result.positions_m.size()));
    if (is_new) result.positions_m.push_back(x);
    number_of.push_back(found->second);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    result.triangles.push_back({number_of[at(a)], number_of[at(b)], number_of[at(c)]});
  }
  return result;
}

TriangleMesh icosahedron() {
  const double g = std::numbers::phi;
  TriangleMesh mesh;
  mesh.positions_m = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

}  // namespace

TriangleMesh make_plane(double side_m, int cells) {
  TriangleMesh mesh;
  add_grid(mesh, Vec3(-0.5 * side_m, -0.5 * side_m, 0.0), Vec3(side_m, 0, 0), Vec3(0, side_m, 0), cells);
  return mesh;
}

TriangleMesh make_box(const Vec3& size_m, int cells) {
  TriangleMesh mesh;
  const Vec3 x(size_m.x(), 0, 0), y(0, size_m.y(), 0), z(0, 0, size_m.z());
  const Vec3 low = -0.5 * size_m;
  add_grid(mesh, low + z, x, y, cells);
  add_grid(mesh, low, y, x, cells);
  add_grid(mesh, low, x, z, cells);
  add_grid(mesh, low + y, z, x, cells);
  add_grid(mesh, low, z, y, cells);
  add_grid(mesh, low + x, y, z, cells);
  return welded(mesh);
}

TriangleMesh make_groove(double opening_rad, double depth_m, int cells) {
  TriangleMesh mesh;
  const double half_m = depth_m * std::tan(0.5 * opening_rad);
  const Vec3 along(0, depth_m, 0);
  add_grid(mesh, Vec3(0, -0.5 * depth_m, 0), Vec3(half_m, 0, depth_m), along, cells);
  add_grid(mesh, Vec3(-half_m, -0.5 * depth_m, depth_m), Vec3(half_m, 0, -depth_m), along, cells);
  return welded(mesh);
}

TriangleMesh refined(const TriangleMesh& mesh, int times) {
  TriangleMesh result = mesh;
  for (int time = 0; time < times; ++time) {
    std::map<std::pair<int, int>, int> middles;
    std::vector<std::array<int, 3>> finer;
    const auto middle = [&](int a, int b) {
      const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(result.positions_m.size()));
      const Vec3 halfway_m = 0.5 * (result.positions_m[at(a)] + result.positions_m[at(b)]);
      if (is_new) result.positions_m.push_back(halfway_m);
      return found->second;
    };
    for (const auto& [a, b, c] : result.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    result.triangles = std::move(finer);
  }
  return result;
}

TriangleMesh make_ball(double radius_m, int levels) {
  TriangleMesh mesh = icosahedron();
  for (int level = 0; level < levels; ++level) mesh = refined(mesh, 1);
  for (Vec3& vertex : mesh.positions_m) vertex = radius_m * vertex.normalized();
  return mesh;
}

}  // namespace myotact::geometry
