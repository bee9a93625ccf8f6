#include "haptics/surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "geometry/closest_point.h"

namespace myotact::haptics {

void write_patch(const geometry::TriangleMesh& mesh, const std::vector<Vec3>& previous_m,
                 const std::vector<Vec3>& current_m, const Vec3& centre_m, messages::LocalModel& model) {
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
  std::vector<int> local(mesh.positions_m.size(), -1);
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

}  // namespace myotact::haptics
