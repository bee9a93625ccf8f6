#pragma once

#include <memory>
#include <vector>

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include "geometry/triangle_mesh.h"

namespace myotact::peers {

/// The plain god-object (Zilles and Salisbury 1995): a point that goes straight to the device, by rays through Bullet's
/// tree of boxes, and slides along up to three planes that it meets on the way. It knows nothing of motion of the
/// surface. No friction.
class GodObject {
 public:
  explicit GodObject(const geometry::TriangleMesh& mesh);
  GodObject(const GodObject&) = delete;
  GodObject& operator=(const GodObject&) = delete;

  /// The surface's vertices are there now: Bullet's boxes are refitted.
  void move_surface(const std::vector<Vec3>& positions_m);
  void place(const Vec3& position_m) { p_m_ = position_m; }
  void tick(const Vec3& goal_m);
  const Vec3& position_m() const { return p_m_; }

 private:
  bool cast(const Vec3& to_m, double& share, Vec3& normal);

  std::vector<Vec3> vertices_m_;
  std::vector<int> indices_;
  btTriangleIndexVertexArray array_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
  btVector3 low_, high_;
  Vec3 p_m_ = Vec3::Zero();
};

}  // namespace myotact::peers
