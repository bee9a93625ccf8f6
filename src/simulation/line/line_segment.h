#pragma once

#include "anatomy/specimen.h"
#include "simulation/skeleton/skeleton.h"

namespace myotact::simulation {

/// A point on the way of a line or a strand, where it is now.
struct LineStop {
  int body = -1;  // -1: it moves by itself
  Vec3 p_W = Vec3::Zero();
};

/// The way from one stop to the next, straight or round a surface, in the skeleton's pose. World frame.
struct LineSegment {
  LineStop from, to;                                        // in the order of the line
  double length_m = 0.0;                                    // 0 when the stops coincide
  Vec3 slope_from = Vec3::Zero(), slope_to = Vec3::Zero();  // dl by the stops' positions: unit, or 0
  /// Second derivatives of the length: from from, from to, to to; with the surface held.
  Mat3 bend_from_1_m = Mat3::Zero(), bend_mixed_1_m = Mat3::Zero(), bend_to_1_m = Mat3::Zero();
  int surface_body = -1;  // of the surface on its way; -1: none
  bool clears = true;     // false: the surface is there and cannot be cleared (geometry::WrapPath)

  /// Whether rotating the joint moves the stops and the surface against each other.
  bool changes_with(const Skeleton& skeleton, int joint) const;
  /// Derivatives by the angles of the joints: of the length, first and second, and of slope_from. The surface moves
  /// with its body: what counts is how the stops move relative to it.
  double by_angle(const Skeleton& skeleton, int joint) const;                  // [m/rad]
  double by_angles(const Skeleton& skeleton, int joint_a, int joint_b) const;  // [m/rad^2]
  Vec3 slope_from_by_angle(const Skeleton& skeleton, int joint) const;         // [1/rad]; `from` moves by itself
};

/// Length and derivatives of the way between two stops. `wrap` may be null: a straight way. Two stops that coincide
/// give a segment of no length and no slope.
LineSegment measure_segment(const Skeleton& skeleton, const LineStop& from, const LineStop& to,
                            const anatomy::LineWrap* wrap);

/// Points between the ends of a segment that has a surface on its way.
inline constexpr int kWrapPoints = 15;
/// Joins the segment's points to `points_m`: `from`, and on the geodesic round a surface kWrapPoints more; not `to`.
/// World frame; X_WB is the pose of the surface's body, not read without a wrap.
void add_segment_points(const Vec3& from_W, const Vec3& to_W, const anatomy::LineWrap* wrap, const Pose& X_WB,
                        std::vector<Vec3>& points_m);

}  // namespace myotact::simulation
