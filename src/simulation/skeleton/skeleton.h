#pragma once

#include <span>
#include <vector>

#include "anatomy/specimen.h"
#include "core/pose.h"

namespace myotact::simulation {

/// The tree of rigid bodies in generalised coordinates: one angle a joint, in the specimen's order (a weld's stays 0).
/// Bodies without a joint above them stand still. Positive torques flex.
///
/// All sums follow from where a point of a body goes when joint j rotates by dq: dp = w_j x (p - c_j) dq if the body is
/// distal to j, else 0. Single caller; const functions may be called from several threads.
class Skeleton {
 public:
  /// Joints and bodies are copied; in the file pose, nothing locked. Throws Error BadData for a universal or ball joint
  /// (see anatomy::with_hinge_chains), an index out of range, a centre that is not finite, not one axis and one rising
  /// range a hinge, an axis that is not a unit vector, a body below two joints or a loop.
  explicit Skeleton(const anatomy::Specimen& specimen);

  int joint_count() const { return static_cast<int>(joints_.size()); }  // welds included
  int body_count() const { return static_cast<int>(bodies_.size()); }
  /// Indices are not checked, here and below.
  const anatomy::Joint& joint(int joint) const { return joints_[index(joint)]; }
  const anatomy::Body& body(int body) const { return bodies_[index(body)]; }
  /// A hinge that is not locked. Locking changes no pose: it is for the callers that solve for the angles.
  bool moves(int joint) const;
  void set_locked(int joint, bool locked) { locked_[index(joint)] = locked; }
  bool locked(int joint) const { return locked_[index(joint)]; }

  /// Puts the bodies in the pose `angles_rad` (one a joint, a weld's is not read; ranges and locks do not count).
  /// Allocates nothing.
  void set_pose(std::span<const double> angles_rad);
  double angle_rad(int joint) const { return angles_rad_[index(joint)]; }  // as set last; 0 for a weld

  // ---- in the pose set last
  /// X_WL: maps a body point's rest position to where it is now.
  const Pose& body_pose(int body) const { return poses_[index(body)]; }
  Vec3 axis_W(int joint) const { return axes_W_[index(joint)]; }       // unit; 0 for a weld
  Vec3 centre_W(int joint) const { return centres_W_[index(joint)]; }  // on its axis
  /// True when rotating `joint` moves `body` (locked or not); never of a weld.
  bool is_distal(int body, int joint) const { return distal_[index(body) * joints_.size() + index(joint)]; }

  /// dp/dq_joint [m/rad] of the point of `body` that is at p_W now; world frame, 0 when the joint does not move the
  /// body.
  Vec3 point_derivative(int body, int joint, const Vec3& p_W) const;
  /// d2p/(dq_a dq_b) [m/rad^2], symmetric in the joints, likewise.
  Vec3 point_second_derivative(int body, int joint_a, int joint_b, const Vec3& p_W) const;

  Vec3 com_W(int body) const;            // centre of mass
  Mat3 inertia_W_kg_m2(int body) const;  // about the body's centre of mass, world axes
  /// Inertia of everything distal about the joint's axis [kg m^2].
  double inertia_kg_m2(int joint) const;

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  void check_joint(int joint) const;
  void order_joints();

  std::vector<anatomy::Joint> joints_;
  std::vector<anatomy::Body> bodies_;
  std::vector<int> order_;    // joints, proximal before distal
  std::vector<int> place_;    // of a joint in order_
  std::vector<char> distal_;  // bodies x joints
  std::vector<char> locked_;  // joints
  std::vector<double> angles_rad_;
  std::vector<Pose> poses_;  // bodies
  std::vector<Vec3> axes_W_, centres_W_;
};

}  // namespace myotact::simulation
