#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "anatomy/specimen.h"
#include "simulation/skeleton/skeleton.h"

namespace myotact::simulation {

/// Length of a muscle line and its derivatives by the joint angles, in the skeleton's pose. Rows of joints that cannot
/// rotate (welds) are 0; locked joints have theirs.
struct LineGeometry {
  double length_m = 0.0;             // round its wraps
  Eigen::VectorXd slope_m_rad;       // dl/dq; the moment arm is r = -dl/dq, positive flexes
  Eigen::MatrixXd curvature_m_rad2;  // d2l/dq2 = -dr/dq
  int stuck_wrap = -1;               // index of a wrap that the line cannot clear in this pose; -1: none
};

/// Fills `geometry`. Exact for points and surfaces that ride on bodies (ellipsoids: 1e-9). Two points that coincide add
/// nothing. Allocates only when `geometry` was made for another number of joints.
void measure_line(const anatomy::MuscleLine& line, const Skeleton& skeleton, LineGeometry& geometry);

/// Whether the line has points or surfaces on both sides of the joint. Does not depend on the pose.
bool spans_joint(const anatomy::MuscleLine& line, const Skeleton& skeleton, int joint);

/// Where the line is now, in the world: its points, and kWrapPoints (line_segment.h) between the ends of each wrapped
/// segment, evenly spread. Their number does not change with the pose.
std::vector<Vec3> line_points_W(const anatomy::MuscleLine& line, const Skeleton& skeleton);
/// The same at the file pose.
std::vector<Vec3> line_points_L(const anatomy::MuscleLine& line);

/// The pull of a muscle along its line, by line_force() (rigid tendon) or resting_force() (a Line muscle's own).
struct LineForce {
  double fibre_stretch = 0.0;  // fibre length over the optimal one
  double force_N = 0.0;        // >= 0 unless the fibre is far below any living length
  double stiffness_N_m = 0.0;  // dF/dl at held activation; negative beyond the optimum length
  double damping_Ns_m = 0.0;   // dF/d(dl/dt), >= 0
};

/// Fibres of constant width lo sin(pennation) as in hill_muscle.h, rest_stretch x lo long at the file pose, on a tendon
/// that does not stretch: the finite-element muscles are calibrated to this force and slope. `elongation_m` = line
/// length now - at the file pose; `speed_m_s` its rate. All zero when the fibres would have to push.
/// Real-time safe.
LineForce line_force(const anatomy::Muscle& muscle, double elongation_m, double speed_m_s, double activation);

/// What one muscle line does to one joint: tau = r F, K = r^2 k - (dr/dq) F, B = r^2 b.
struct LineJointTerms {
  double torque_Nm = 0.0;        // positive flexes
  double muscle_Nm_rad = 0.0;    // r^2 k
  double geometry_Nm_rad = 0.0;  // -(dr/dq) F
  double damping_Nms_rad = 0.0;  // r^2 b

  /// K, both terms.
  double stiffness_Nm_rad() const { return muscle_Nm_rad + geometry_Nm_rad; }
  /// Adds term by term.
  LineJointTerms& operator+=(const LineJointTerms& other);
};

/// Of the joint's own angle: coupling between joints (r_i r_j) is left out. Real-time safe.
LineJointTerms line_joint_terms(const LineGeometry& geometry, const LineForce& force, int joint);

// ---- polylines

/// Arc length up to each point over the whole; one a point, the last is 1. All 0 but the last when the line has no
/// length.
std::vector<double> arc_fractions(std::span<const Vec3> points_m);

/// A place on a polyline.
struct LinePlace {
  int segment = 0;                 // between points segment and segment + 1
  double along = 0.0;              // 0 .. 1 within the segment
  double fraction = 0.0;           // by `fractions`, usually arc length at rest
  Vec3 position_m = Vec3::Zero();  // in the frame of the points
  double distance_m = 0.0;         // from the point asked for; 0 for place_at_fraction
};

/// The place of the polyline nearest to p_m; the first of several. `fractions` (one a point, rising from 0 to 1)
/// usually come from arc_fractions of the rest points. At least 1 point. Real-time safe.
LinePlace nearest_place(std::span<const Vec3> points_m, std::span<const double> fractions, const Vec3& p_m) noexcept;
/// The place whose fraction is given; outside 0 .. 1 it is clamped. At least 1 point. Real-time safe.
LinePlace place_at_fraction(std::span<const Vec3> points_m, std::span<const double> fractions,
                            double fraction) noexcept;

}  // namespace myotact::simulation
