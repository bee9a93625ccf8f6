#include "prepare/loft/rings.h"

#include <cmath>
#include <utility>

namespace myotact::prepare {

namespace {

constexpr double kGrid_m = 1e-7;

Vec3 rounded(const Vec3& point) {
  return point.unaryExpr([](double x) { return std::round(x / kGrid_m) * kGrid_m; });
}

}  // namespace

geometry::TriangleMesh join_rings(const std::vector<Ring>& rings, const Vec3& first_tip, const Vec3& last_tip) {
  geometry::TriangleMesh mesh;
  const auto around = static_cast<int>(rings.front().size());
  const auto count = static_cast<int>(rings.size());
  for (const Ring& ring : rings) {
    for (const Vec3& point : ring) mesh.positions_m.push_back(rounded(point));
  }
  const int first = around * count;
  const int last = first + 1;
  mesh.positions_m.push_back(rounded(first_tip));
  mesh.positions_m.push_back(rounded(last_tip));
  for (int j = 0; j < around; ++j) {
    const int next = (j + 1) % around;
    for (int i = 0; i + 1 < count; ++i) {
      const int a = i * around + j, b = i * around + next, c = a + around, d = b + around;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
    mesh.triangles.push_back({first, next, j});
    mesh.triangles.push_back({last, (count - 1) * around + j, (count - 1) * around + next});
  }
  if (geometry::enclosed_volume_m3(mesh) < 0.0) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

}  // namespace myotact::prepare
