#include "geometry/triangle_mesh.h"

#include <map>
#include <utility>

#include <Eigen/Geometry>

namespace myotact::geometry {

namespace {

/// Twice the area, along the outward normal.
Vec3 area_vector(const TriangleMesh& mesh, const std::array<int, 3>& triangle) {
  const Vec3& a = mesh.positions_m[static_cast<std::size_t>(triangle[0])];
  const Vec3& b = mesh.positions_m[static_cast<std::size_t>(triangle[1])];
  const Vec3& c = mesh.positions_m[static_cast<std::size_t>(triangle[2])];
  return (b - a).cross(c - a);
}

}  // namespace

double enclosed_volume_m3(const TriangleMesh& mesh) {
  if (mesh.positions_m.empty()) return 0.0;
  const Vec3 origin = mesh.positions_m.front();  // keeps precision for meshes far from the world origin
  double six_volumes = 0.0;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 corner = mesh.positions_m[static_cast<std::size_t>(triangle[0])] - origin;
    six_volumes += corner.dot(area_vector(mesh, triangle));
  }
  return six_volumes / 6.0;
}

double surface_area_m2(const TriangleMesh& mesh) {
  double twice_area = 0.0;
  for (const auto& triangle : mesh.triangles) twice_area += area_vector(mesh, triangle).norm();
  return twice_area / 2.0;
}

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions_m.size(), Vec3::Zero());
  for (const auto& triangle : mesh.triangles) {
    const Vec3 area = area_vector(mesh, triangle);
    for (const int vertex : triangle) normals[static_cast<std::size_t>(vertex)] += area;
  }
  for (Vec3& normal : normals) normal = normal.norm() > 0.0 ? Vec3(normal.normalized()) : Vec3::UnitZ();
  return normals;
}

int bad_edge_count(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, std::pair<int, int>> uses;  // undirected edge -> {forward, backward} uses
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int from = triangle[i];
      const int to = triangle[(i + 1) % 3];
      auto& use = uses[std::minmax(from, to)];
      ++(from < to ? use.first : use.second);
    }
  }
  int bad = 0;
  for (const auto& [edge, use] : uses) bad += use == std::pair{1, 1} ? 0 : 1;
  return bad;
}

}  // namespace myotact::geometry
