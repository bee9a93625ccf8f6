#include "simulation/muscle/bone_contact_forces.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/at.h"
#include "simulation/contact/contact_law.h"

namespace myotact::simulation {
namespace {

/// One node in touch, everything in the world frame. The gradient and curvature are those of its energy.
struct Touch {
  int node = -1;
  int body = -1;
  Vec3 position_m = Vec3::Zero();
  Vec3 gradient_N = Vec3::Zero();
  Mat3 curvature_N_m = Mat3::Zero();
};

void add_touch_forces(const TissuePass& pass, const Touch& touch) {
  pass.system.internal_N.segment<3>(3 * touch.node) += touch.gradient_N;
  pass.system.force_scale_N += touch.gradient_N.squaredNorm();
  for (int j = 0; j < pass.skeleton.joint_count(); ++j) {
    const Vec3 jacobian = pass.skeleton.point_derivative(touch.body, j, touch.position_m);
    pass.system.muscle_torque_Nm[j] += jacobian.dot(touch.gradient_N);
  }
}

/// Second derivatives of the energy E(x, q). A joint rotation by dq moves the bone past a node at rest by -J dq, J the
/// jacobian, and rotates the forces with it; that nothing changes when the node moves along with the bone gives the
/// angles' own part. `rotates`: the forces' directions rotate (left out of a safe tangent).
void add_touch_tangent(const TissuePass& pass, const Touch& touch, bool rotates) {
  const Skeleton& skeleton = pass.skeleton;
  const int f = pass.tissue.free_index[at(touch.node)];
  if (pass.load.in_factor)
    pass.system.factor.matrix.add(f, f, touch.curvature_N_m);
  else
    pass.system.matrix.add(f, f, touch.curvature_N_m);
  const auto rotated = [&](int joint) {
    return rotates ? Vec3(skeleton.axis_W(joint).cross(touch.gradient_N)) : Vec3(Vec3::Zero());
  };
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    if (!skeleton.is_distal(touch.body, j)) continue;
    const Vec3 jacobian = skeleton.point_derivative(touch.body, j, touch.position_m);
    const Vec3 pushed = touch.curvature_N_m * jacobian;
    pass.system.coupling_N_rad.col(j).segment<3>(3 * f) += rotated(j) - pushed;
    for (int k = 0; k < skeleton.joint_count(); ++k) {
      if (!skeleton.is_distal(touch.body, k)) continue;
      const Vec3 other = skeleton.point_derivative(touch.body, k, touch.position_m);
      double stiffness = pushed.dot(other) - rotated(j).dot(other) - rotated(k).dot(jacobian);
      if (rotates) {
        const Vec3 second = skeleton.point_second_derivative(touch.body, j, k, touch.position_m);
        stiffness -= touch.gradient_N.dot(second);
      }
      pass.system.joint_stiffness_Nm_rad(j, k) += stiffness;
    }
  }
}

void add_node(const TissuePass& pass, const BoneShape& bone, const BonePatch::Node& node) {
  const Vec3 x = node_vector(pass.state.now.position_m, node.node);
  const Pose& X_WL = pass.skeleton.body_pose(bone.body);
  const Vec3 y = X_WL.rotation.transpose() * (x - X_WL.translation_m);
  if (!bone.field.may_be_inside(y)) return;
  const geometry::DistanceSample d = bone.field.sample(y);
  const double overlap_m = -d.distance_m - node.rest_depth_m;
  const ContactPressure law = contact_pressure(kBoneContact, overlap_m);
  if (!(law.pressure_Pa > 0.0)) return;
  pass.system.contact_depth_m = std::max(pass.system.contact_depth_m, overlap_m);
  pass.system.contact_N += node.area_m2 * law.pressure_Pa * d.gradient.norm();
  Touch touch{node.node, bone.body, x, -node.area_m2 * law.pressure_Pa * (X_WL.rotation * d.gradient), Mat3::Zero()};
  add_touch_forces(pass, touch);
  if (!pass.tangent || pass.load.contact_held) return;
  const bool rotates = !pass.load.definite;
  Mat3 curvature = node.area_m2 * law.slope_Pa_m * d.gradient * d.gradient.transpose();
  if (rotates) curvature -= node.area_m2 * law.pressure_Pa * d.hessian_1_m;
  touch.curvature_N_m = X_WL.rotation * curvature * X_WL.rotation.transpose();
  add_touch_tangent(pass, touch, rotates);
}

/// The list of nodes is made anew once one of them may have come this much nearer to a bone: a press and a degree or
/// two of a joint, for which a limb takes some 50 ms.
constexpr double kKeptWay_m = 3e-3;

Eigen::AlignedBox3d box_of(const BonePatch& patch, const Eigen::VectorXd& position_m) {
  Eigen::AlignedBox3d box;
  for (const BonePatch::Node& node : patch.nodes) box.extend(node_vector(position_m, node.node));
  return box;
}

/// How far a point that rests in the world, anywhere in the box, has moved as a bone sees it, at most.
double way_past_m(const Eigen::AlignedBox3d& box, const Pose& then, const Pose& now) {
  const Vec3 centre = box.center();
  const Vec3 shift = now.rotation.transpose() * (centre - now.translation_m) -
                     then.rotation.transpose() * (centre - then.translation_m);
  return shift.norm() + (now.rotation - then.rotation).norm() * 0.5 * box.diagonal().norm();
}

const Pose& pose_of(const TissuePass& pass, const BonePatch& patch) {
  return pass.skeleton.body_pose((*pass.tissue.bone_contact.bones)[at(patch.bone)].body);
}

bool still_near(const TissuePass& pass) {
  const NearBones& near = pass.state.near_bones;
  const Eigen::VectorXd& position_m = pass.state.now.position_m;
  if (near.position_m.size() != position_m.size()) return false;
  Eigen::AlignedBox3d box;
  double farthest_m2 = 0.0;
  for (int n = 0; n < static_cast<int>(position_m.size() / 3); ++n) {
    box.extend(node_vector(position_m, n));
    farthest_m2 = std::max(farthest_m2, (node_vector(position_m, n) - node_vector(near.position_m, n)).squaredNorm());
  }
  const double left_m = kKeptWay_m - std::sqrt(farthest_m2);
  const std::vector<BonePatch>& patches = pass.tissue.bone_contact.patches;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (!(way_past_m(box, near.bones[p], pose_of(pass, patches[p])) < left_m)) return false;
  }
  return true;
}

/// Nothing that is left out can touch before it has gone kKeptWay_m.
void look_around(const TissuePass& pass) {
  const BoneContact& contact = pass.tissue.bone_contact;
  NearBones& near = pass.state.near_bones;
  near.position_m = pass.state.now.position_m;
  near.nodes.clear();
  near.bones.clear();
  for (std::size_t p = 0; p < contact.patches.size(); ++p) {
    const BonePatch& patch = contact.patches[p];
    const BoneShape& bone = (*contact.bones)[at(patch.bone)];
    const Pose& X_WL = near.bones.emplace_back(pose_of(pass, patch));
    const Vec3 centre_W = X_WL * bone.field.centre_m();
    if (box_of(patch, near.position_m).exteriorDistance(centre_W) > bone.field.radius_m() + kKeptWay_m) continue;
    for (std::size_t n = 0; n < patch.nodes.size(); ++n) {
      const Vec3 x = node_vector(near.position_m, patch.nodes[n].node);
      const double clearance_m = bone.field.clearance_m(X_WL.rotation.transpose() * (x - X_WL.translation_m));
      if (!(clearance_m > kKeptWay_m)) near.nodes.push_back({static_cast<int>(p), static_cast<int>(n)});
    }
  }
}

}  // namespace

void add_bone_contact(const TissuePass& pass) {
  const BoneContact& contact = pass.tissue.bone_contact;
  if (contact.patches.empty()) return;
  if (!still_near(pass)) look_around(pass);
  for (const NearBones::Node& near : pass.state.near_bones.nodes) {
    const BonePatch& patch = contact.patches[at(near.patch)];
    add_node(pass, (*contact.bones)[at(patch.bone)], patch.nodes[at(near.node)]);
  }
}

}  // namespace myotact::simulation
