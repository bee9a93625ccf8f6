#include "simulation/muscle/tendon_strand.h"

#include "simulation/line/line_segment.h"

namespace myotact::simulation {
namespace {

/// Share of the stiffness that a slack strand keeps, so that the tangent never vanishes.
constexpr double kSlackShare = 1e-6;

LineStop stop_at(const TendonStrand& strand, const Skeleton& skeleton, std::size_t k) {
  const TendonStrand::BodyPoint& point = strand.points[k];
  return {point.body, skeleton.body_pose(point.body) * point.rest_m};
}

/// Calls act(segment) for each segment from the belly's end to the bone.
template <class Act>
void each_segment(const TendonStrand& strand, const Skeleton& skeleton, const Vec3& p_W_m, Act&& act) {
  LineStop from{-1, p_W_m};
  for (std::size_t k = 0; k < strand.points.size(); ++k) {
    const LineStop to = stop_at(strand, skeleton, k);
    const auto& wrap = strand.points[k].wrap;
    act(measure_segment(skeleton, from, to, wrap ? &*wrap : nullptr));
    from = to;
  }
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

}  // namespace

double strand_length(const TendonStrand& strand, const Skeleton& skeleton, const Vec3& p_W_m) {
  double length = 0.0;
  each_segment(strand, skeleton, p_W_m, [&](const LineSegment& segment) { length += segment.length_m; });
  return length;
}

StrandState evaluate_strand(const TendonStrand& strand, const Skeleton& skeleton, const Vec3& p_W_m) {
  const int joints = skeleton.joint_count();
  StrandState state;
  state.length_m = strand_length(strand, skeleton, p_W_m);
  const Tension tension = tension_at(strand, state.length_m - strand.rest_length_m);
  state.tension_N = tension.force_N;
  state.coupling_N_rad = Eigen::Matrix3Xd::Zero(3, joints);
  state.stiffness_Nm_rad = Eigen::MatrixXd::Zero(joints, joints);
  Vec3 by_p = Vec3::Zero();                                  // dl/dp
  Eigen::VectorXd by_angle = Eigen::VectorXd::Zero(joints);  // dl/dq
  each_segment(strand, skeleton, p_W_m, [&](const LineSegment& segment) {
    const bool first = segment.from.body < 0;
    if (first) {
      by_p = segment.slope_from;
      state.stiffness_N_m = tension.force_N * segment.bend_from_1_m;
    }
    for (int a = 0; a < joints; ++a) {
      if (!segment.changes_with(skeleton, a)) continue;
      by_angle[a] += segment.by_angle(skeleton, a);
      for (int b = 0; b < joints; ++b) {
        if (segment.changes_with(skeleton, b)) {
          state.stiffness_Nm_rad(a, b) += tension.force_N * segment.by_angles(skeleton, a, b);
        }
      }
    }
    for (int a = 0; first && a < joints; ++a) {
      state.coupling_N_rad.col(a) = tension.force_N * segment.slope_from_by_angle(skeleton, a);
    }
  });
  state.pull_N = tension.force_N * by_p;
  state.torque_Nm = tension.force_N * by_angle;
  state.stiffness_N_m += tension.slope_N_m * by_p * by_p.transpose();
  state.coupling_N_rad += tension.slope_N_m * by_p * by_angle.transpose();
  state.stiffness_Nm_rad += tension.slope_N_m * by_angle * by_angle.transpose();
  return state;
}

}  // namespace myotact::simulation
