#include "simulation/skeleton/skeleton_loads.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace myotact::simulation {
namespace {

/// Angle past the end of the range by which a spring with a toe is strained: past^2 / (2 toe) within the toe, half a
/// toe less than `past_rad` beyond it. Signed as `past_rad`.
double strained_rad(double past_rad) {
  const double size = std::abs(past_rad);
  const double strain = size < kRangeToe_rad ? size * size / (2.0 * kRangeToe_rad) : size - 0.5 * kRangeToe_rad;
  return std::copysign(strain, past_rad);
}

/// Spring about q = 0, damper, and the stop at the ends of the range.
void add_passive(const Skeleton& skeleton, int j, double velocity_rad_s, SkeletonLoads& loads) {
  const anatomy::Joint& joint = skeleton.joint(j);
  if (joint.type != anatomy::JointType::Hinge) return;
  const double q = skeleton.angle_rad(j);
  loads.force_Nm[j] -= joint.stiffness_Nm_rad * q + joint.damping_Nms_rad * velocity_rad_s;
  loads.passive_Nm_rad[j] = joint.stiffness_Nm_rad;
  loads.damping_Nms_rad[j] = joint.damping_Nms_rad;
  const auto& [lowest, highest] = joint.range_rad[0];
  const double past_rad = q > highest ? q - highest : std::min(0.0, q - lowest);  // signed
  if (past_rad == 0.0) return;
  const double share = std::min(1.0, std::abs(past_rad) / kRangeToe_rad);  // of the full stiffness and damping
  const double stop_Nm =
      -kRangeStiffness_Nm_rad * strained_rad(past_rad) - kRangeDamping_Nms_rad * share * velocity_rad_s;
  if (stop_Nm * past_rad >= 0.0) return;  // leaving so fast that the damper would pull it back: a stop only pushes
  loads.force_Nm[j] += stop_Nm;
  loads.passive_Nm_rad[j] += kRangeStiffness_Nm_rad * share;
  loads.damping_Nms_rad[j] += kRangeDamping_Nms_rad * share;
}

/// Acceleration that a body has at zero joint accelerations, because the joints rotate each other's axes.
struct BiasAcceleration {
  Vec3 com_m_s2 = Vec3::Zero();
  Vec3 angular_rad_s2 = Vec3::Zero();
  Vec3 angular_velocity_rad_s = Vec3::Zero();
};

BiasAcceleration bias(const Skeleton& skeleton, int body, std::span<const double> velocities_rad_s) {
  BiasAcceleration sum;
  const Vec3 com_W = skeleton.com_W(body);
  for (int k = 0; k < skeleton.joint_count(); ++k) {
    if (!skeleton.is_distal(body, k)) continue;
    const double velocity_k = velocities_rad_s[static_cast<std::size_t>(k)];
    sum.angular_velocity_rad_s += skeleton.axis_W(k) * velocity_k;
    for (int l = 0; l < skeleton.joint_count(); ++l) {
      const double product = velocity_k * velocities_rad_s[static_cast<std::size_t>(l)];
      sum.com_m_s2 += skeleton.point_second_derivative(body, k, l, com_W) * product;
      const bool rotates = skeleton.is_distal(body, l) && skeleton.is_distal(skeleton.joint(l).parent, k);
      if (rotates) sum.angular_rad_s2 += skeleton.axis_W(k).cross(skeleton.axis_W(l)) * product;
    }
  }
  return sum;
}

/// Kane's projection of one body's weight and inertia on the joint angles.
void add_body(const Skeleton& skeleton, int body, const SkeletonInput& input, SkeletonLoads& loads) {
  const double mass_kg = skeleton.body(body).mass_kg;
  const Vec3 com_W = skeleton.com_W(body);
  const Mat3 inertia = skeleton.inertia_W_kg_m2(body);
  const BiasAcceleration b = bias(skeleton, body, input.velocities_rad_s);
  const Vec3& omega = b.angular_velocity_rad_s;
  const Vec3 force_N = mass_kg * (input.gravity_m_s2 - b.com_m_s2);
  const Vec3 moment_Nm = -inertia * b.angular_rad_s2 - omega.cross(inertia * omega);
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    if (!skeleton.is_distal(body, j)) continue;
    const Vec3 derivative_m = skeleton.point_derivative(body, j, com_W);
    loads.force_Nm[j] += derivative_m.dot(force_N) + skeleton.axis_W(j).dot(moment_Nm);
    for (int k = 0; k < skeleton.joint_count(); ++k) {
      if (!skeleton.is_distal(body, k)) continue;
      loads.mass_kg_m2(j, k) += mass_kg * derivative_m.dot(skeleton.point_derivative(body, k, com_W)) +
                                skeleton.axis_W(j).dot(inertia * skeleton.axis_W(k));
      loads.stiffness_Nm_rad(j, k) -=
          mass_kg * input.gravity_m_s2.dot(skeleton.point_second_derivative(body, j, k, com_W));
    }
  }
}

}  // namespace

void SkeletonLoads::compute(const Skeleton& skeleton, const SkeletonInput& input) {
  const int n = skeleton.joint_count();
  mass_kg_m2.setZero(n, n);
  stiffness_Nm_rad.setZero(n, n);
  force_Nm.setZero(n);
  damping_Nms_rad.setZero(n);
  passive_Nm_rad.setZero(n);
  for (int body = 0; body < skeleton.body_count(); ++body) add_body(skeleton, body, input, *this);
  for (int j = 0; j < n; ++j) {
    const auto i = static_cast<std::size_t>(j);
    force_Nm[j] += input.external_torque_Nm[i];
    add_passive(skeleton, j, input.velocities_rad_s[i], *this);
    stiffness_Nm_rad(j, j) += passive_Nm_rad[j];
    if (skeleton.joint(j).type == anatomy::JointType::Weld) mass_kg_m2(j, j) = 1.0;
  }
}

}  // namespace myotact::simulation
