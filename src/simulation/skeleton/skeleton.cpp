#include "simulation/skeleton/skeleton.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/text.h"

namespace myotact::simulation {
namespace {

constexpr double kUnitTolerance = 1e-6;  // of an axis; files give at least seven digits

Error joint_error(const anatomy::Joint& joint, const std::string& problem) {
  return bad_data("specimen", "joint '" + joint.key + "'", problem);
}

}  // namespace

Skeleton::Skeleton(const anatomy::Specimen& specimen) : joints_(specimen.joints), bodies_(specimen.bodies) {
  for (int j = 0; j < joint_count(); ++j) check_joint(j);
  locked_.assign(joints_.size(), 0);
  order_joints();
  poses_.resize(bodies_.size());
  axes_W_.resize(joints_.size());
  centres_W_.resize(joints_.size());
  angles_rad_.assign(joints_.size(), 0.0);
  const std::vector<double> file_pose(joints_.size(), 0.0);
  set_pose(file_pose);
}

void Skeleton::check_joint(int j) const {
  const anatomy::Joint& joint = joints_[index(j)];
  if (joint.type != anatomy::JointType::Hinge && joint.type != anatomy::JointType::Weld) {
    throw joint_error(joint,
                      "only hinges and welds are supported here; universal and ball joints become chains of hinges by "
                      "anatomy::with_hinge_chains");
  }
  for (const int body : {joint.parent, joint.child}) {
    if (body < 0 || body >= body_count()) {
      throw joint_error(joint, "body " + std::to_string(body) + " must be 0 .. " + std::to_string(body_count() - 1));
    }
  }
  if (!joint.centre_m.allFinite()) throw joint_error(joint, "centre_m must be finite");
  if (joint.type == anatomy::JointType::Weld) return;
  if (joint.axes.size() != 1 || joint.range_rad.size() != 1) {
    throw joint_error(joint, "a hinge has exactly one axis and one range");
  }
  if (!(std::abs(joint.axes[0].norm() - 1.0) <= kUnitTolerance)) {
    throw joint_error(joint, "axis has length " + to_text(joint.axes[0].norm()) + "; must be 1, normalise it");
  }
  const auto& [lowest, highest] = joint.range_rad[0];
  if (!(lowest <= highest)) {
    throw joint_error(joint, "range " + to_text(lowest) + " .. " + to_text(highest) + " must rise");
  }
}

/// Bodies are reached from those that no joint carries; what is not reached hangs on a loop.
void Skeleton::order_joints() {
  std::vector<int> carrier(bodies_.size(), -1);
  for (int j = 0; j < joint_count(); ++j) {
    int& joint_above = carrier[index(joints_[index(j)].child)];
    if (joint_above >= 0) {
      throw joint_error(joints_[index(j)], "body '" + bodies_[index(joints_[index(j)].child)].key +
                                               "' already hangs on joint '" + joints_[index(joint_above)].key +
                                               "'; a body has one joint above it");
    }
    joint_above = j;
  }
  distal_.assign(bodies_.size() * joints_.size(), 0);
  std::vector<int> joints_above(joints_.size(), 0);
  for (int b = 0; b < body_count(); ++b) {
    int above = carrier[index(b)];
    for (int climbed = 0; above >= 0; ++climbed) {
      if (climbed > joint_count()) throw joint_error(joints_[index(above)], "the joints form a loop; cut it");
      distal_[index(b) * joints_.size() + index(above)] = joints_[index(above)].type == anatomy::JointType::Hinge;
      if (carrier[index(b)] != above) ++joints_above[index(carrier[index(b)])];
      above = carrier[index(joints_[index(above)].parent)];
    }
  }
  order_.resize(joints_.size());
  for (int j = 0; j < joint_count(); ++j) order_[index(j)] = j;
  std::stable_sort(order_.begin(), order_.end(),
                   [&](int a, int b) { return joints_above[index(a)] < joints_above[index(b)]; });
  place_.resize(joints_.size());
  for (int i = 0; i < joint_count(); ++i) place_[index(order_[index(i)])] = i;
}

bool Skeleton::moves(int j) const {
  return joints_[index(j)].type == anatomy::JointType::Hinge && !locked_[index(j)];
}

void Skeleton::set_pose(std::span<const double> angles_rad) {
  for (const int j : order_) {
    const anatomy::Joint& joint = joints_[index(j)];
    const Pose& X_WP = poses_[index(joint.parent)];
    const bool hinge = joint.type == anatomy::JointType::Hinge;
    const double angle_rad = hinge ? angles_rad[index(j)] : 0.0;
    Mat3 rotation = Mat3::Identity();
    if (hinge) rotation = Eigen::AngleAxisd(angle_rad, joint.axes[0]).toRotationMatrix();
    // The rotation leaves the centre in place: p -> R (p - c) + c.
    poses_[index(joint.child)] = X_WP * Pose{rotation, joint.centre_m - rotation * joint.centre_m};
    angles_rad_[index(j)] = angle_rad;
    axes_W_[index(j)] = hinge ? Vec3(X_WP.rotation * joint.axes[0]) : Vec3(Vec3::Zero());
    centres_W_[index(j)] = X_WP * joint.centre_m;
  }
}

Vec3 Skeleton::point_derivative(int body, int joint, const Vec3& p_W) const {
  if (!is_distal(body, joint)) return Vec3::Zero();
  return axes_W_[index(joint)].cross(p_W - centres_W_[index(joint)]);
}

Vec3 Skeleton::point_second_derivative(int body, int joint_a, int joint_b, const Vec3& p_W) const {
  if (!is_distal(body, joint_a) || !is_distal(body, joint_b)) return Vec3::Zero();
  // The proximal joint rotates the arm that the distal one makes.
  const bool a_first = place_[index(joint_a)] <= place_[index(joint_b)];
  const int proximal = a_first ? joint_a : joint_b;
  const int distal = a_first ? joint_b : joint_a;
  return axes_W_[index(proximal)].cross(axes_W_[index(distal)].cross(p_W - centres_W_[index(distal)]));
}

Vec3 Skeleton::com_W(int body) const {
  return poses_[index(body)] * bodies_[index(body)].com_m;
}

Mat3 Skeleton::inertia_W_kg_m2(int body) const {
  const auto& [xx, yy, zz, xy, xz, yz] = bodies_[index(body)].inertia_kg_m2;
  Mat3 I_L;
  I_L << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const Mat3& R_WL = poses_[index(body)].rotation;
  return R_WL * I_L * R_WL.transpose();
}

double Skeleton::inertia_kg_m2(int joint) const {
  double sum = 0.0;
  for (int b = 0; b < body_count(); ++b) {
    if (!is_distal(b, joint)) continue;
    const Vec3 derivative_m = point_derivative(b, joint, com_W(b));
    sum +=
        bodies_[index(b)].mass_kg * derivative_m.squaredNorm() + axis_W(joint).dot(inertia_W_kg_m2(b) * axis_W(joint));
  }
  return sum;
}

}  // namespace myotact::simulation
