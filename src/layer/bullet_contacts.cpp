#include "layer/bullet_contacts.h"

#include <algorithm>

#include "layer/bullet_vectors.h"

namespace myotact::layer {

// NOLINTNEXTLINE(readability-function-size): the seven parameters are Bullet's
btScalar ContactCollector::addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int, int index_a,
                                           const btCollisionObjectWrapper* b, int, int index_b) {
  if (!(point.getDistance() <= 0.0)) return 0.0;
  const bool tool_first = a->getCollisionObject() == tool;  // the normal points from b to a
  messages::ReportedContact contact;
  const btVector3 normal = tool_first ? point.m_normalWorldOnB : -point.m_normalWorldOnB;
  const btVector3 place = tool_first ? point.getPositionWorldOnB() : point.getPositionWorldOnA();
  contact.normal_world = to_array(from_bullet(normal));
  contact.point_world_m = to_array(from_bullet(place));
  contact.penetration_m = -point.getDistance();
  found.push_back({contact, (tool_first ? b : a)->getCollisionObject(), tool_first ? index_b : index_a});
  return 0.0;
}

void sort_by_depth(std::vector<messages::ReportedContact>& contacts) {
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const auto& a, const auto& b) { return a.penetration_m > b.penetration_m; });
}

}  // namespace myotact::layer
