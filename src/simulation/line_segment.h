#pragma once

#include "anatomy/specimen.h"
#include "simulation/skeleton.h"

namespace myotact::simulation {

/// A point on the way of a line or a strand, where it is now.
struct LineStop {
  int body = -1;  // -1: it moves by itself
  Vec3 p_W = Vec3::Zero();
};

/// The way from one stop to the next, straight or round a surface, in the skeleton's pose. World frame.
struct LineSegment {
  LineStop from, to;
  double length_m = 0.0;
  Vec3 slope_from = Vec3::Zero(), slope_to = Vec3::Zero();  // dl by the stops' positions
  Mat3 bend_from_1_m = Mat3::Zero(), bend_mixed_1_m = Mat3::Zero(), bend_to_1_m = Mat3::Zero();
  int surface_body = -1;  // of the surface on its way; -1: none
  bool clears = true;     // false: the surface is there and cannot be cleared (geometry::WrapPath)

  /// Whether turning the joint moves the stops and the surface against each other.
  bool changes_with(const Skeleton& skeleton, int joint) const;
  // The surface moves with its body: what counts is how the stops move relative to it. All by the angles of the joints.
  double by_angle(const Skeleton& skeleton, int joint) const;                  // [m/rad]
  double by_angles(const Skeleton& skeleton, int joint_a, int joint_b) const;  // [m/rad^2]
  Vec3 slope_from_by_angle(const Skeleton& skeleton, int joint) const;         // [1/rad]; `from` moves by itself
};

/// `wrap` may be null. Two stops that coincide give a segment of no length and no slope.
LineSegment measure_segment(const Skeleton& skeleton, const LineStop& from, const LineStop& to,
                            const anatomy::LineWrap* wrap);

/// Joins the segment's points to `points_m`: `from`, and on the way round a surface kWrapPoints more; not `to`.
/// X_WB is the pose of the surface's body.
inline constexpr int kWrapPoints = 15;
void add_segment_points(const Vec3& from_W, const Vec3& to_W, const anatomy::LineWrap* wrap, const Pose& X_WB,
                        std::vector<Vec3>& points_m);

}  // namespace myotact::simulation
