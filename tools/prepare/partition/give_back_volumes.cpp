#include "prepare/partition/give_back_volumes.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "core/at.h"

namespace myotact::prepare {

namespace {

/// One round leaves what the moved surface's own growth adds, a hundredth of the loss.
constexpr int kRounds = 2;

/// What a vertex borders on, if not on one part and nothing alone.
constexpr int kNone = -1, kBorder = -2;

std::vector<int> free_parts(const Interfaces& interfaces, const NearPlaces& kept) {
  std::vector<int> part(interfaces.positions_m.size(), kNone);
  for (const auto& [vertices, inner, outer] : interfaces.faces) {
    for (const int v : vertices) {
      const bool alone = outer == 0 && (part[at(v)] == kNone || part[at(v)] == inner);
      part[at(v)] = alone ? inner : kBorder;
    }
  }
  for (std::size_t v = 0; v < part.size(); ++v) {
    if (part[v] > 0 && kept.contain(interfaces.positions_m[v])) part[v] = kBorder;
  }
  return part;
}

Vec3 area_m2(const Interfaces& interfaces, const Interfaces::Face& face) {
  const Vec3& a = interfaces.positions_m[at(face.vertices[0])];
  const Vec3& b = interfaces.positions_m[at(face.vertices[1])];
  const Vec3& c = interfaces.positions_m[at(face.vertices[2])];
  return 0.5 * (b - a).cross(c - a);
}

}  // namespace

std::vector<double> enclosed_volumes_m3(const Interfaces& interfaces, std::size_t parts) {
  std::vector<double> volumes_m3(parts, 0.0);
  if (interfaces.positions_m.empty()) return volumes_m3;
  const Vec3 middle_m = interfaces.positions_m.front();  // cones from far away would lose digits
  for (const Interfaces::Face& face : interfaces.faces) {
    const Vec3 corner_m = interfaces.positions_m[at(face.vertices[0])] - middle_m;
    const double cone_m3 = corner_m.dot(area_m2(interfaces, face)) / 3.0;
    volumes_m3[face.inner - std::size_t{1}] += cone_m3;
    if (face.outer > 0) volumes_m3[face.outer - std::size_t{1}] -= cone_m3;
  }
  return volumes_m3;
}

std::vector<double> areas_m2(const Interfaces& interfaces, std::size_t parts) {
  std::vector<double> areas(parts, 0.0);
  for (const Interfaces::Face& face : interfaces.faces) {
    const double area = area_m2(interfaces, face).norm();
    areas[face.inner - std::size_t{1}] += area;
    if (face.outer > 0) areas[face.outer - std::size_t{1}] += area;
  }
  return areas;
}

void give_back_volumes(const std::vector<double>& volumes_m3, double most_m, const NearPlaces& kept,
                       Interfaces& interfaces) {
  const std::vector<int> part = free_parts(interfaces, kept);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<double> now_m3 = enclosed_volumes_m3(interfaces, volumes_m3.size());
    std::vector<Vec3> normals(interfaces.positions_m.size(), Vec3::Zero());
    std::vector<double> moving_m2(volumes_m3.size(), 0.0);  // a vertex moves a third of each of its triangles
    for (const Interfaces::Face& face : interfaces.faces) {
      const Vec3 area = area_m2(interfaces, face);
      for (const int v : face.vertices) {
        if (part[at(v)] < 0) continue;
        normals[at(v)] += area;
        moving_m2[face.inner - std::size_t{1}] += area.norm() / 3.0;
      }
    }
    for (std::size_t v = 0; v < normals.size(); ++v) {
      if (part[v] < 0 || normals[v].isZero()) continue;
      const std::size_t p = at(part[v] - 1);
      const double way_m = std::clamp((volumes_m3[p] - now_m3[p]) / moving_m2[p], -most_m, most_m);
      interfaces.positions_m[v] += way_m * normals[v].normalized();
    }
  }
}

}  // namespace myotact::prepare
