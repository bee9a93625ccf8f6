#include "god_object.h"

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <Eigen/Geometry>

namespace myotact::peers {
namespace {

constexpr double kOff_m = 1e-5;  // it stays this far off a plane, so that the next ray starts outside

btVector3 to_bullet(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

struct FirstHit : btTriangleRaycastCallback {
  FirstHit(const btVector3& from, const btVector3& to) : btTriangleRaycastCallback(from, to, kF_FilterBackfaces) {}
  btScalar reportHit(const btVector3& hit_normal, btScalar fraction, int /*part*/, int /*triangle*/) override {
    normal = hit_normal;
    return fraction;
  }
  btVector3 normal{0, 0, 0};
};

btIndexedMesh indexed(const std::vector<Vec3>& vertices_m, const std::vector<int>& indices) {
  btIndexedMesh mesh;
  mesh.m_numTriangles = static_cast<int>(indices.size() / 3);
  mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices.data());
  mesh.m_triangleIndexStride = 3 * sizeof(int);
  mesh.m_numVertices = static_cast<int>(vertices_m.size());
  mesh.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices_m.data());
  mesh.m_vertexStride = sizeof(Vec3);
  mesh.m_vertexType = PHY_DOUBLE;
  return mesh;
}

}  // namespace

GodObject::GodObject(const geometry::TriangleMesh& mesh) : vertices_m_(mesh.positions_m) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : vertices_m_) box.extend(x);
  const Vec3 room = 0.2 * box.sizes();
  low_ = to_bullet(box.min() - room);
  high_ = to_bullet(box.max() + room);
  for (const auto& triangle : mesh.triangles) indices_.insert(indices_.end(), triangle.begin(), triangle.end());
  array_.addIndexedMesh(indexed(vertices_m_, indices_), PHY_INTEGER);
  shape_ = std::make_unique<btBvhTriangleMeshShape>(&array_, true, low_, high_);
}

void GodObject::move_surface(const std::vector<Vec3>& positions_m) {
  vertices_m_ = positions_m;  // in the same place in memory
  shape_->refitTree(low_, high_);
}

bool GodObject::cast(const Vec3& to_m, double& share, Vec3& normal) {
  const btVector3 from = to_bullet(p_m_), to = to_bullet(to_m);
  FirstHit hit(from, to);
  shape_->performRaycast(&hit, from, to);
  share = hit.m_hitFraction;
  normal = Vec3(hit.normal.x(), hit.normal.y(), hit.normal.z()).normalized();
  return share < 1.0;
}

void GodObject::tick(const Vec3& goal_m) {
  Vec3 target_m = goal_m, planes[2];
  for (int met = 0; met < 3; ++met) {
    const Vec3 way_m = target_m - p_m_;
    const double length_m = way_m.norm();
    if (length_m < 1e-9) return;
    const double longer = 1.0 + kOff_m / length_m;
    double share = 1.0;
    Vec3 normal;
    if (!cast(p_m_ + longer * way_m, share, normal)) {
      p_m_ = target_m;
      return;
    }
    p_m_ += share * longer * way_m + kOff_m * normal;
    if (met == 2) return;
    planes[met] = normal;
    const Vec3 left_m = goal_m - p_m_;
    if (met == 0) {
      target_m = p_m_ + left_m - normal.dot(left_m) * normal;
    } else {
      const Vec3 line = planes[0].cross(planes[1]).normalized();
      target_m = line.allFinite() ? Vec3(p_m_ + line.dot(left_m) * line) : p_m_;
    }
  }
}

}  // namespace myotact::peers
