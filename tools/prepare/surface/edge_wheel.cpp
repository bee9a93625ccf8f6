#include "prepare/surface/edge_wheel.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace myotact::prepare {

std::vector<SpokeTriangle> wheel_around(const geometry::TriangleMesh& mesh, int low, int high,
                                        std::span<const EdgeUse> uses) {
  const Vec3& from = mesh.positions_m[at(low)];
  const Vec3 axis = (mesh.positions_m[at(high)] - from).normalized();
  const Vec3 first = axis.unitOrthogonal();
  const Vec3 second = axis.cross(first);
  std::vector<SpokeTriangle> wheel;
  for (const EdgeUse& use : uses) {
    const Vec3 apex = mesh.positions_m[at(head_of(mesh, next_corner(use.side)))] - from;
    wheel.push_back({use.side, tail_of(mesh, use.side) == low, std::atan2(apex.dot(second), apex.dot(first))});
  }
  std::sort(wheel.begin(), wheel.end(), [](const SpokeTriangle& a, const SpokeTriangle& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.side < b.side;
  });
  return wheel;
}

}  // namespace myotact::prepare
