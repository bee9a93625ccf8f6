#include "simulation/line/line_segment.h"

#include <array>

#include <Eigen/Geometry>

namespace myotact::simulation {
namespace {

/// Rotation from the surface's frame to the world, and a world point there.
struct SurfacePlace {
  Mat3 R_WS;
  Pose X_LW;
  const anatomy::LineWrap& wrap;

  SurfacePlace(const anatomy::LineWrap& surface, const Pose& X_WB)
      : R_WS(X_WB.rotation * surface.axes.transpose()), X_LW(X_WB.inverse()), wrap(surface) {}
  Vec3 local(const Vec3& p_W) const { return in_frame_of(wrap, X_LW * p_W); }
};

Vec3 velocity(const Skeleton& skeleton, int body, int joint, const Vec3& p_W) {
  return body < 0 ? Vec3(Vec3::Zero()) : skeleton.point_derivative(body, joint, p_W);
}

/// dp/dq of a stop as seen from the surface.
Vec3 relative_velocity(const Skeleton& skeleton, const LineStop& stop, int surface_body, int joint) {
  return velocity(skeleton, stop.body, joint, stop.p_W) - velocity(skeleton, surface_body, joint, stop.p_W);
}

Vec3 second_derivative(const Skeleton& skeleton, int body, int a, int b, const Vec3& p_W) {
  return body < 0 ? Vec3(Vec3::Zero()) : skeleton.point_second_derivative(body, a, b, p_W);
}

Vec3 rotation_axis(const Skeleton& skeleton, int surface_body, int joint) {
  const bool rotates = surface_body >= 0 && skeleton.is_distal(surface_body, joint);
  return rotates ? skeleton.axis_W(joint) : Vec3(Vec3::Zero());
}

/// d2p/(dq_a dq_b) of a stop as seen from the surface: with p = X(q) s, differentiated twice for s.
Vec3 relative_bend(const Skeleton& skeleton, const LineStop& stop, int surface_body, int a, int b) {
  return second_derivative(skeleton, stop.body, a, b, stop.p_W) -
         second_derivative(skeleton, surface_body, a, b, stop.p_W) -
         rotation_axis(skeleton, surface_body, a).cross(relative_velocity(skeleton, stop, surface_body, b)) -
         rotation_axis(skeleton, surface_body, b).cross(relative_velocity(skeleton, stop, surface_body, a));
}

LineSegment straight_segment(const LineStop& from, const LineStop& to) {
  LineSegment segment{from, to};
  const Vec3 e = to.p_W - from.p_W;
  segment.length_m = e.norm();
  if (segment.length_m == 0.0) return segment;
  const Vec3 t = e / segment.length_m;
  segment.slope_from = -t;
  segment.slope_to = t;
  segment.bend_from_1_m = segment.bend_to_1_m = (Mat3::Identity() - t * t.transpose()) / segment.length_m;
  segment.bend_mixed_1_m = -segment.bend_from_1_m;
  return segment;
}

}  // namespace

bool LineSegment::changes_with(const Skeleton& skeleton, int joint) const {
  const auto distal = [&](int body) { return body >= 0 && skeleton.is_distal(body, joint); };
  if (distal(from.body) != distal(to.body)) return true;
  return surface_body >= 0 && distal(surface_body) != distal(to.body);
}

double LineSegment::by_angle(const Skeleton& skeleton, int joint) const {
  return slope_from.dot(relative_velocity(skeleton, from, surface_body, joint)) +
         slope_to.dot(relative_velocity(skeleton, to, surface_body, joint));
}

double LineSegment::by_angles(const Skeleton& skeleton, int a, int b) const {
  const Vec3 from_a = relative_velocity(skeleton, from, surface_body, a);
  const Vec3 from_b = relative_velocity(skeleton, from, surface_body, b);
  const Vec3 to_a = relative_velocity(skeleton, to, surface_body, a);
  const Vec3 to_b = relative_velocity(skeleton, to, surface_body, b);
  return from_a.dot(bend_from_1_m * from_b) + to_a.dot(bend_to_1_m * to_b) + from_a.dot(bend_mixed_1_m * to_b) +
         from_b.dot(bend_mixed_1_m * to_a) + slope_from.dot(relative_bend(skeleton, from, surface_body, a, b)) +
         slope_to.dot(relative_bend(skeleton, to, surface_body, a, b));
}

Vec3 LineSegment::slope_from_by_angle(const Skeleton& skeleton, int joint) const {
  return bend_from_1_m * relative_velocity(skeleton, from, surface_body, joint) +
         bend_mixed_1_m * relative_velocity(skeleton, to, surface_body, joint) +
         rotation_axis(skeleton, surface_body, joint).cross(slope_from);
}

LineSegment measure_segment(const Skeleton& skeleton, const LineStop& from, const LineStop& to,
                            const anatomy::LineWrap* wrap) {
  if (wrap == nullptr) return straight_segment(from, to);
  const SurfacePlace place(*wrap, skeleton.body_pose(wrap->body));
  const geometry::WrapPath path =
      geometry::wrap_path(anatomy::surface_of(*wrap), place.local(from.p_W), place.local(to.p_W));
  LineSegment segment{from, to};
  segment.length_m = path.length_m;
  segment.surface_body = wrap->body;
  segment.clears = path.clears;
  segment.slope_from = place.R_WS * path.slope_p;
  segment.slope_to = place.R_WS * path.slope_q;
  segment.bend_from_1_m = place.R_WS * path.bend_pp_1_m * place.R_WS.transpose();
  segment.bend_mixed_1_m = place.R_WS * path.bend_pq_1_m * place.R_WS.transpose();
  segment.bend_to_1_m = place.R_WS * path.bend_qq_1_m * place.R_WS.transpose();
  return segment;
}

void add_segment_points(const Vec3& from_W, const Vec3& to_W, const anatomy::LineWrap* wrap, const Pose& X_WB,
                        std::vector<Vec3>& points_m) {
  points_m.push_back(from_W);
  if (wrap == nullptr) return;
  const SurfacePlace place(*wrap, X_WB);
  std::array<Vec3, kWrapPoints> between;
  geometry::wrap_points(anatomy::surface_of(*wrap), place.local(from_W), place.local(to_W), between);
  for (const Vec3& p_S : between) points_m.push_back(X_WB * (wrap->axes.transpose() * p_S + wrap->centre_m));
}

}  // namespace myotact::simulation
