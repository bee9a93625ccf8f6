#include "layer/model_contacts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "core/at.h"
#include "geometry/closest_point.h"

namespace myotact::layer {
namespace {

/// The nearest place of one surface to a point, and on which side of it the point is.
struct Nearest {
  int surface = -1;
  double distance_m = 0.0;
  Vec3 place_m = Vec3::Zero(), face_normal = Vec3::Zero();
};

/// Of the triangles of a model, one a surface; of triangles equally near, the one that the point lies most over.
std::vector<Nearest> nearest_places(const messages::LocalModel& model, const Vec3& p_m) {
  constexpr double kEqual_m = 1e-12;  // a foot on an edge is as near to both triangles, but for rounding
  std::vector<Nearest> found;
  for (std::size_t t = 0; t < at(model.triangle_count); ++t) {
    const messages::LocalModel::Triangle& triangle = model.triangles[t];
    const auto corner = [&](std::size_t k) { return to_vec3(model.current_world_m[at(triangle.vertices[k])]); };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    const Vec3 place_m = geometry::closest_point_on_triangle(p_m, a, b, c).position_m;
    const Nearest here{triangle.surface, (p_m - place_m).norm(), place_m, (b - a).cross(c - a).normalized()};
    if (found.empty() || found.back().surface != here.surface) {  // a surface's triangles come together
      found.push_back(here);
      continue;
    }
    Nearest& best = found.back();
    const bool as_near = std::abs(here.distance_m - best.distance_m) <= kEqual_m;
    const auto over = [&](const Nearest& n) { return std::abs(n.face_normal.dot(p_m - n.place_m)); };
    if (as_near ? over(here) > over(best) : here.distance_m < best.distance_m) best = here;
  }
  return found;
}

/// What a sphere there meets of the surface; a middle that lies inside has come through the nearest face.
messages::ReportedContact contact_of(const Nearest& nearest, const Vec3& middle_m, double radius_m) {
  const Vec3 way_m = middle_m - nearest.place_m;
  const bool inside = nearest.face_normal.dot(way_m) < 0.0;
  const Vec3 away = nearest.distance_m > 0.0 ? Vec3(way_m / nearest.distance_m) : nearest.face_normal;
  messages::ReportedContact contact;
  contact.surface = nearest.surface;
  contact.point_world_m = to_array(nearest.place_m);
  contact.normal_world = to_array(inside ? Vec3(-away) : away);
  contact.penetration_m = radius_m + (inside ? nearest.distance_m : -nearest.distance_m);
  return contact;
}

}  // namespace

messages::ReportedContacts contacts_in_model(const messages::LocalModel& around, const Vec3& middle_m,
                                             double radius_m) {
  messages::ReportedContacts reported;
  reported.tool_world_m = to_array(middle_m);
  std::vector<messages::ReportedContact> contacts;
  for (const Nearest& nearest : nearest_places(around, middle_m)) {
    const messages::ReportedContact contact = contact_of(nearest, middle_m, radius_m);
    if (contact.penetration_m >= 0.0) contacts.push_back(contact);
  }
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const auto& a, const auto& b) { return a.penetration_m > b.penetration_m; });
  const std::size_t count = std::min(contacts.size(), reported.contacts.size());
  std::copy_n(contacts.begin(), count, reported.contacts.begin());
  reported.count = static_cast<std::int32_t>(count);
  return reported;
}

}  // namespace myotact::layer
