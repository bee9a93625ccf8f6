#include "simulation/tendon_strand.h"

#include <cmath>

namespace myotact::simulation {
namespace {

/// Segments shorter than this have no direction [m]; far below any anatomical distance.
constexpr double kShortestSegment_m = 1e-9;
/// Share of the stiffness that a slack strand keeps, so that the tangent never vanishes.
constexpr double kSlackShare = 1e-6;

Vec3 point_at(const TendonStrand& strand, const Skeleton& skeleton, std::size_t k) {
  const TendonStrand::BodyPoint& point = strand.points[k];
  return skeleton.body_pose(point.body) * point.rest_m;
}

struct Tension {
  double force_N;
  double slope_N_m;
};

Tension tension_at(const TendonStrand& strand, double extension_m) {
  const double k = strand.stiffness_N_m;
  if (extension_m <= 0.0) return {kSlackShare * k * extension_m, kSlackShare * k};
  const double slack = kSlackShare * k * extension_m;
  if (extension_m < strand.toe_m) {
    return {slack + 0.5 * k * extension_m * extension_m / strand.toe_m, k * (kSlackShare + extension_m / strand.toe_m)};
  }
  return {slack + k * (extension_m - 0.5 * strand.toe_m), k * (1.0 + kSlackShare)};
}

/// A point of the strand on its way from end to end; body -1 for the free end.
struct Stop {
  int body = -1;
  Vec3 position_m;
};

/// Adds what a segment's ends do to the stiffness by moving on arcs.
void add_bend(const Skeleton& skeleton, const Stop& from, const Stop& to, const Vec3& force_N,
              Eigen::MatrixXd& stiffness_Nm_rad) {
  for (int b = 0; b < skeleton.joint_count(); ++b) {
    for (int a = 0; a < skeleton.joint_count(); ++a) {
      Vec3 bend = skeleton.point_second_derivative(to.body, a, b, to.position_m);
      if (from.body >= 0) bend -= skeleton.point_second_derivative(from.body, a, b, from.position_m);
      stiffness_Nm_rad(a, b) += force_N.dot(bend);
    }
  }
}

Eigen::Matrix3Xd slope_of(const Skeleton& skeleton, const Stop& stop) {
  Eigen::Matrix3Xd slope(3, skeleton.joint_count());
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    slope.col(j) = skeleton.point_derivative(stop.body, j, stop.position_m);
  }
  return slope;
}

}  // namespace

double strand_length(const TendonStrand& strand, const Skeleton& skeleton, const Vec3& p_W_m) {
  double length = 0.0;
  Vec3 from = p_W_m;
  for (std::size_t k = 0; k < strand.points.size(); ++k) {
    const Vec3 to = point_at(strand, skeleton, k);
    length += (to - from).norm();
    from = to;
  }
  return length;
}

StrandState evaluate_strand(const TendonStrand& strand, const Skeleton& skeleton, const Vec3& p_W_m) {
  const auto joints = Eigen::Index{skeleton.joint_count()};
  StrandState state;
  state.length_m = strand_length(strand, skeleton, p_W_m);
  const Tension tension = tension_at(strand, state.length_m - strand.rest_length_m);
  state.tension_N = tension.force_N;
  state.coupling_N_rad = Eigen::Matrix3Xd::Zero(3, joints);
  state.stiffness_Nm_rad = Eigen::MatrixXd::Zero(joints, joints);
  Vec3 by_p = Vec3::Zero();                                         // dl/dp
  Eigen::VectorXd by_angle = Eigen::VectorXd::Zero(joints);         // dl/dq
  Eigen::Matrix3Xd slope_from = Eigen::Matrix3Xd::Zero(3, joints);  // of the segment's start; p moves by itself
  Stop from{-1, p_W_m};
  for (std::size_t k = 0; k < strand.points.size(); ++k) {
    const Stop to{strand.points[k].body, point_at(strand, skeleton, k)};
    const Eigen::Matrix3Xd slope_to = slope_of(skeleton, to);
    const double length = (to.position_m - from.position_m).norm();
    if (length > kShortestSegment_m) {
      const Vec3 t = (to.position_m - from.position_m) / length;
      const Mat3 turning = tension.force_N / length * (Mat3::Identity() - t * t.transpose());
      const Eigen::Matrix3Xd slope = slope_to - slope_from;
      if (k == 0) {
        by_p = -t;
        state.stiffness_N_m = turning;
        state.coupling_N_rad = -turning * slope;
      }
      by_angle += slope.transpose() * t;
      state.stiffness_Nm_rad += slope.transpose() * turning * slope;
      add_bend(skeleton, from, to, tension.force_N * t, state.stiffness_Nm_rad);
    }
    from = to;
    slope_from = slope_to;
  }
  state.pull_N = tension.force_N * by_p;
  state.torque_Nm = tension.force_N * by_angle;
  state.stiffness_N_m += tension.slope_N_m * by_p * by_p.transpose();
  state.coupling_N_rad += tension.slope_N_m * by_p * by_angle.transpose();
  state.stiffness_Nm_rad += tension.slope_N_m * by_angle * by_angle.transpose();
  return state;
}

}  // namespace myotact::simulation
