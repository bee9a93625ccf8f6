#pragma once

#include <vector>

#include <btBulletCollisionCommon.h>

#include "messages/local_model.h"

namespace myotact::layer {

/// Takes from Bullet every point at which the body of a tool is inside of another one.
struct ContactCollector : btCollisionWorld::ContactResultCallback {
  explicit ContactCollector(const btCollisionObject& tool) : tool(&tool) {}

  // NOLINTNEXTLINE(readability-function-size): the seven parameters are Bullet's
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int part_a, int index_a,
                           const btCollisionObjectWrapper* b, int part_b, int index_b) override;

  struct Found {
    messages::ReportedContact contact;  // without its surface
    const btCollisionObject* touched;
    int child;  // of a compound shape
  };
  const btCollisionObject* tool;
  std::vector<Found> found;
};

/// The deepest first, equals as they came.
void sort_by_depth(std::vector<messages::ReportedContact>& contacts);

}  // namespace myotact::layer
