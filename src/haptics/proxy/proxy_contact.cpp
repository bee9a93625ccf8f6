// What the proxy touches at the end of a tick.

#include <algorithm>

#include <Eigen/Geometry>

#include "core/at.h"
#include "haptics/proxy/proxy.h"

namespace myotact::haptics {

namespace {

/// A stuck sphere may be off its anchor by this share of the radius (normal travel over a curved surface) before the
/// anchor is renewed: the anchor is what keeps it from creeping, so it is kept as long as it makes sense.
constexpr double kAnchorSlack = 0.05;

}  // namespace

void Proxy::settle_contact(const Projection& held, const Tick& tick) noexcept {
  const bool touches = held.active_count > 0;
  if (!touches) {
    contact_ = {};
    anchor_ = {};
    friction_.release();
    return;
  }
  int strongest = 0;
  for (int i = 1; i < held.active_count; ++i) {
    if (held.reaction_m[at(i)] > held.reaction_m[at(strongest)]) strongest = i;
  }
  const MovingSurface& surface = *tick.surface;
  const int local = near_.near(touching_[at(held.active[at(strongest)])]).local;
  const bool keeps = !tick.slipped && anchor_.local >= 0 &&
                     (p_m_ - anchored_m(surface, 1.0)).norm() < kAnchorSlack * settings_.radius_m;
  if (!keeps) set_anchor(surface, local);
  const geometry::TrianglePoint touched = surface.closest_point(p_m_, local, 1.0);
  contact_.active = true;
  contact_.surface = surface.triangle(local).surface;
  contact_.triangle = surface.triangle(local).triangle;
  contact_.barycentric = touched.barycentric;
  contact_.point_m = touched.position_m;
  contact_.normal = (held.point_m - tick.goal.position_m).normalized();
  contact_.velocity_m_s = seat_motion_m(held, surface, surface.motion_m(local, touched.barycentric)) / tick.dt_s;
  contact_.sliding = tick.slipped;
  settle_friction(tick);
  contact_.bearing = held.active_count;
  settle_beside(surface);
}

/// What the tissue carries the sphere by in the tick: along the surface as the strongest contact's does, which moved by
/// `strongest_m`, and along the normal as all that hold it do together, each by its share of the force.
Vec3 Proxy::seat_motion_m(const Projection& held, const MovingSurface& surface,
                          const Vec3& strongest_m) const noexcept {
  if (held.active_count == 1) return strongest_m;
  double lifted_m2 = 0.0, reactions_m = 0.0;
  for (int i = 0; i < held.active_count; ++i) {
    const int place = held.active[at(i)], local = near_.near(touching_[at(place)]).local;
    const Vec3& normal = touching_spaces_[at(place)].normal;
    const Vec3 moved_m = surface.motion_m(local, surface.closest_point(p_m_, local, 1.0).barycentric);
    lifted_m2 += held.reaction_m[at(i)] * normal.dot(moved_m);
    reactions_m += held.reaction_m[at(i)] * normal.dot(contact_.normal);
  }
  if (!(reactions_m > 0.0)) return strongest_m;
  return strongest_m + (lifted_m2 / reactions_m - contact_.normal.dot(strongest_m)) * contact_.normal;
}

void Proxy::settle_beside(const MovingSurface& surface) noexcept {
  std::array<NearestPoint, messages::kMaxContactsBeside> found;
  const Vec3 outward = (p_m_ - contact_.point_m).normalized();
  const int count = near_.nearest_beside(p_m_, contact_.surface, outward, settings_.radius_m + kBeside_m, found);
  contact_.beside = {};
  for (int i = 0; i < count; ++i) {
    const NearestPoint& point = found[at(i)];
    const messages::LocalModel::Triangle& triangle = surface.triangle(point.local);
    const double felt_m =
        near_.stand_off_m(point.local) > 0.0 ? skin_.nearest(point, p_m_).distance_m : point.distance_m;
    contact_.beside[at(i)] = {triangle.surface,
                              triangle.triangle,
                              point.barycentric,
                              point.point_m,
                              (p_m_ - point.point_m) / point.distance_m,
                              std::max(0.0, felt_m - settings_.radius_m)};
  }
}

void Proxy::set_anchor(const MovingSurface& surface, int local) noexcept {
  const geometry::TrianglePoint touched = surface.closest_point(p_m_, local, 1.0);
  anchor_.held = true;
  anchor_.surface = surface.triangle(local).surface;
  anchor_.triangle = surface.triangle(local).triangle;
  anchor_.barycentric = touched.barycentric;
  anchor_.offset_T_m = surface.frame_W(local, 1.0).transpose() * (p_m_ - touched.position_m);
  anchor_.local = local;
}

}  // namespace myotact::haptics
