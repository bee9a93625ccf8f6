#include "prepare/remesh/restore_volume.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

namespace myotact::prepare {

namespace {

/// Passes: where nothing stands in the way, the volume is nearly linear in the offset and four leave less than 1e-6.
constexpr int kPasses = 12;
constexpr double kCloseEnough = 1e-5;
/// Triangles narrower than this are not made by moving.
constexpr double kLeastShape = 0.1;

/// Volume, and for every vertex the vector area of its triangles: the volume's derivative is a third of it.
struct VolumeGradient {
  double volume_m3 = 0.0;
  std::vector<Vec3> area_m2;
};

VolumeGradient measure(const GuardedMesh& guarded) {
  const HalfEdgeMesh& mesh = guarded.mesh();
  VolumeGradient result;
  result.area_m2.assign(mesh.n_vertices(), Vec3::Zero());
  for (const auto f : mesh.faces()) {
    if (mesh.status(f).deleted()) continue;
    const auto ids = guarded.vertices_of(f.idx());
    const auto [a, b, c] = guarded.corners_of(ids);
    const Vec3 area_m2 = 0.5 * (b - a).cross(c - a);
    result.volume_m3 += a.dot(b.cross(c)) / 6.0;
    for (const int v : ids) result.area_m2[static_cast<std::size_t>(v)] += area_m2;
  }
  return result;
}

}  // namespace

double restore_volume(GuardedMesh& guarded, double volume_m3, std::vector<double> room_m) {
  for (int pass = 0; pass < kPasses; ++pass) {
    const VolumeGradient now = measure(guarded);
    if (std::abs(now.volume_m3 / volume_m3 - 1.0) < kCloseEnough) break;
    double area_m2 = 0.0;
    for (const Vec3& area : now.area_m2) area_m2 += area.norm() / 3.0;
    const double offset_m = (volume_m3 - now.volume_m3) / area_m2;
    for (std::size_t v = 0; v < now.area_m2.size(); ++v) {
      const OpenMesh::VertexHandle handle(static_cast<int>(v));
      if (guarded.mesh().status(handle).deleted()) continue;
      const double way_m = room_m.empty() ? offset_m : std::min(offset_m, room_m[v]);
      const bool moved =
          guarded.try_move(handle, guarded.position_m(handle) + way_m * now.area_m2[v].normalized(), kLeastShape);
      if (moved && !room_m.empty()) room_m[v] -= way_m;
    }
  }
  return measure(guarded).volume_m3 / volume_m3 - 1.0;
}

}  // namespace myotact::prepare
