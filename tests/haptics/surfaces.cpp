#include "surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "geometry/closest_point.h"

namespace myotact::haptics {

namespace {

/// Adds a grid over the parallelogram at `corner`, outside along u x v.
void add_grid(TestMesh& mesh, const Vec3& corner, const Vec3& u, const Vec3& v, int cells) {
  const int first = static_cast<int>(mesh.vertices_m.size());
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) mesh.vertices_m.push_back(corner + u * (1.0 * i / cells) + v * (1.0 * j / cells));
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int a = first + j * (cells + 1) + i;
      mesh.triangles.push_back({a, a + 1, a + cells + 2});
      mesh.triangles.push_back({a, a + cells + 2, a + cells + 1});
    }
  }
}

}  // namespace

TestMesh make_plane(double side_m, int cells) {
  TestMesh mesh;
  add_grid(mesh, Vec3(-0.5 * side_m, -0.5 * side_m, 0.0), Vec3(side_m, 0, 0), Vec3(0, side_m, 0), cells);
  return mesh;
}

TestMesh make_groove(double half_angle_rad, double depth_m, int cells) {
  TestMesh mesh;
  const double half_width_m = depth_m * std::tan(half_angle_rad);
  add_grid(mesh, Vec3(0, -0.5 * depth_m, 0), Vec3(half_width_m, 0, depth_m), Vec3(0, depth_m, 0), cells);
  add_grid(mesh, Vec3(-half_width_m, -0.5 * depth_m, depth_m), Vec3(half_width_m, 0, -depth_m), Vec3(0, depth_m, 0),
           cells);
  return mesh;
}

TestMesh make_box(const Vec3& size_m, int cells) {
  TestMesh mesh;
  const Vec3 x(size_m.x(), 0, 0), y(0, size_m.y(), 0), z(0, 0, size_m.z());
  const Vec3 low = -0.5 * size_m;
  add_grid(mesh, low + z, x, y, cells);
  add_grid(mesh, low, y, x, cells);
  add_grid(mesh, low, x, z, cells);
  add_grid(mesh, low + y, z, x, cells);
  add_grid(mesh, low, z, y, cells);
  add_grid(mesh, low + x, y, z, cells);
  return mesh;
}

TestMesh make_sphere(double radius_m, int levels) {
  const double g = std::numbers::phi;
  TestMesh mesh;
  mesh.vertices_m = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    std::vector<std::array<int, 3>> finer;
    const auto middle = [&](int a, int b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices_m.size()));
      const Vec3 halfway =
          0.5 * (mesh.vertices_m[static_cast<std::size_t>(a)] + mesh.vertices_m[static_cast<std::size_t>(b)]);
      if (is_new) mesh.vertices_m.push_back(halfway);
      return at->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  for (Vec3& vertex : mesh.vertices_m) vertex = radius_m * vertex.normalized();
  return mesh;
}

void write_patch(const TestMesh& mesh, const std::vector<Vec3>& previous_m, const std::vector<Vec3>& current_m,
                 const Vec3& centre_m, messages::LocalModel& model) {
  std::vector<double> distances_m;
  for (const auto& triangle : mesh.triangles) {
    const auto distance_m = [&](const std::vector<Vec3>& x) {
      const auto corner = [&](int i) -> const Vec3& {
        return x[static_cast<std::size_t>(triangle[static_cast<std::size_t>(i)])];
      };
      return (geometry::closest_point_on_triangle(centre_m, corner(0), corner(1), corner(2)).position_m - centre_m)
          .norm();
    };
    double motion_m = 0.0;
    for (const int v : triangle) {
      motion_m =
          std::max(motion_m, (current_m[static_cast<std::size_t>(v)] - previous_m[static_cast<std::size_t>(v)]).norm());
    }
    distances_m.push_back(std::min(distance_m(previous_m), distance_m(current_m)) - motion_m);
  }
  std::vector<int> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  const auto nearer = [&](int a, int b) {
    return distances_m[static_cast<std::size_t>(a)] < distances_m[static_cast<std::size_t>(b)];
  };
  const std::size_t kept = std::min<std::size_t>(order.size(), messages::kMaxLocalTriangles + 1);
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(), nearer);
  std::vector<int> local(mesh.vertices_m.size(), -1);
  model.vertex_count = 0;
  model.triangle_count = 0;
  model.coverage_centre_world_m = to_array(centre_m);
  model.coverage_radius_m = 0.25;
  for (const int t : order) {
    const auto& triangle = mesh.triangles[static_cast<std::size_t>(t)];
    const auto fresh =
        std::count_if(triangle.begin(), triangle.end(), [&](int v) { return local[static_cast<std::size_t>(v)] < 0; });
    const bool fits = model.triangle_count < messages::kMaxLocalTriangles &&
                      model.vertex_count + static_cast<int>(fresh) <= messages::kMaxLocalVertices;
    if (!fits) {
      model.coverage_radius_m = std::max(0.0, distances_m[static_cast<std::size_t>(t)]);
      break;
    }
    messages::LocalModel::Triangle& out = model.triangles[static_cast<std::size_t>(model.triangle_count++)];
    out.surface = 0;
    out.triangle = t;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto v = static_cast<std::size_t>(triangle[corner]);
      if (local[v] < 0) {
        local[v] = model.vertex_count++;
        model.previous_world_m[static_cast<std::size_t>(local[v])] = to_array(previous_m[v]);
        model.current_world_m[static_cast<std::size_t>(local[v])] = to_array(current_m[v]);
      }
      out.vertices[corner] = local[v];
    }
  }
  std::sort(model.triangles.begin(), model.triangles.begin() + model.triangle_count,
            [](const auto& a, const auto& b) { return a.triangle < b.triangle; });
}

double winding_number(const TestMesh& mesh, const std::vector<Vec3>& vertices_m, const Vec3& point_m) {
  double solid_angle = 0.0;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a = vertices_m[static_cast<std::size_t>(triangle[0])] - point_m;
    const Vec3 b = vertices_m[static_cast<std::size_t>(triangle[1])] - point_m;
    const Vec3 c = vertices_m[static_cast<std::size_t>(triangle[2])] - point_m;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    solid_angle += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return solid_angle / (4.0 * std::numbers::pi);
}

}  // namespace myotact::haptics
