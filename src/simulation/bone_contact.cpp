#include "simulation/bone_contact.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "geometry/tet_topology.h"
#include "simulation/contact_law.h"
#include "simulation/tissue_system.h"

namespace myotact::simulation {
namespace {

/// Cells of the bones' fields [m]: a fifth of a canine long bone's radius; smoothing then moves its surface by 0.02 mm.
constexpr double kFieldSpacing_m = 1e-3;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

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
    const Vec3 lever = pass.skeleton.point_derivative(touch.body, j, touch.position_m);
    pass.system.muscle_torque_Nm[j] += lever.dot(touch.gradient_N);
  }
}

/// Second derivatives of the energy E(x, q). A joint turn by dq moves the bone past a node at rest by -lever dq and
/// turns the forces with it; that nothing changes when the node moves along with the bone gives the angles' own part.
/// `turns`: the forces' directions turn (left out of a safe tangent).
void add_touch_tangent(const TissuePass& pass, const Touch& touch, bool turns) {
  const Skeleton& skeleton = pass.skeleton;
  const int f = pass.tissue.free_index[at(touch.node)];
  if (pass.load.in_factor)
    pass.system.factor.matrix.add(f, f, touch.curvature_N_m);
  else
    pass.system.matrix.add(f, f, touch.curvature_N_m);
  const auto turned = [&](int joint) {
    return turns ? Vec3(skeleton.axis_W(joint).cross(touch.gradient_N)) : Vec3(Vec3::Zero());
  };
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    if (!skeleton.is_distal(touch.body, j)) continue;
    const Vec3 lever = skeleton.point_derivative(touch.body, j, touch.position_m);
    const Vec3 pushed = touch.curvature_N_m * lever;
    pass.system.coupling_N_rad.col(j).segment<3>(3 * f) += turned(j) - pushed;
    for (int k = 0; k < skeleton.joint_count(); ++k) {
      if (!skeleton.is_distal(touch.body, k)) continue;
      const Vec3 other = skeleton.point_derivative(touch.body, k, touch.position_m);
      double stiffness = pushed.dot(other) - turned(j).dot(other) - turned(k).dot(lever);
      if (turns) {
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
  const bool turns = !pass.load.definite;
  Mat3 curvature = node.area_m2 * law.slope_Pa_m * d.gradient * d.gradient.transpose();
  if (turns) curvature -= node.area_m2 * law.pressure_Pa * d.hessian_1_m;
  touch.curvature_N_m = X_WL.rotation * curvature * X_WL.rotation.transpose();
  add_touch_tangent(pass, touch, turns);
}

Eigen::AlignedBox3d box_of(const BonePatch& patch, const Eigen::VectorXd& position_m) {
  Eigen::AlignedBox3d box;
  for (const BonePatch::Node& node : patch.nodes) box.extend(node_vector(position_m, node.node));
  return box;
}

}  // namespace

std::shared_ptr<const BoneShapes> make_bone_shapes(const anatomy::Specimen& specimen) {
  auto shapes = std::make_shared<BoneShapes>();
  for (const anatomy::Bone& bone : specimen.bones) {
    if (bone.surface.triangles.empty()) continue;
    shapes->push_back({bone.body, geometry::DistanceField(bone.surface, kFieldSpacing_m)});
  }
  return shapes;
}

std::vector<SurfaceNode> surface_nodes(const geometry::TetMesh& mesh, const std::vector<int>& attachment,
                                       int without_body) {
  std::vector<double> area_m2(mesh.nodes_m.size(), 0.0);
  const double corner = mesh.quadratic() ? 1.0 / 12.0 : 1.0 / 3.0;
  for (const geometry::BoundaryTriangle& face : geometry::boundary_triangles(mesh)) {
    const auto attached = [&](int node) { return without_body >= 0 && attachment[at(node)] == without_body; };
    if (std::any_of(face.corners.begin(), face.corners.end(), attached)) continue;
    const Vec3 &a = mesh.nodes_m[at(face.corners[0])], &b = mesh.nodes_m[at(face.corners[1])],
               &c = mesh.nodes_m[at(face.corners[2])];
    const double area = 0.5 * (b - a).cross(c - a).norm();
    for (const int node : face.corners) area_m2[at(node)] += corner * area;
    if (!mesh.quadratic()) continue;
    for (const int node : face.midsides) area_m2[at(node)] += 0.25 * area;
  }
  std::vector<SurfaceNode> nodes;
  for (std::size_t i = 0; i < area_m2.size(); ++i) {
    if (area_m2[i] > 0.0) nodes.push_back({static_cast<int>(i), area_m2[i]});
  }
  return nodes;
}

BoneContact make_bone_contact(std::shared_ptr<const BoneShapes> bones, const geometry::TetMesh& mesh,
                              const std::vector<int>& attachment) {
  BoneContact contact{std::move(bones), {}};
  for (std::size_t b = 0; b < contact.bones->size(); ++b) {
    const BoneShape& bone = (*contact.bones)[b];
    BonePatch patch{static_cast<int>(b), {}};
    for (const SurfaceNode& node : surface_nodes(mesh, attachment, bone.body)) {
      if (attachment[at(node.node)] >= 0) continue;
      const Vec3& rest = mesh.nodes_m[at(node.node)];
      const double depth_m = bone.field.may_be_inside(rest) ? -bone.field.sample(rest).distance_m : 0.0;
      patch.nodes.push_back({node.node, node.area_m2, std::max(0.0, depth_m)});
    }
    if (!patch.nodes.empty()) contact.patches.push_back(std::move(patch));
  }
  return contact;
}

void add_bone_contact(const TissuePass& pass) {
  const BoneContact& contact = pass.tissue.bone_contact;
  if (contact.patches.empty()) return;
  for (const BonePatch& patch : contact.patches) {
    const BoneShape& bone = (*contact.bones)[at(patch.bone)];
    const Vec3 centre_W = pass.skeleton.body_pose(bone.body) * bone.field.centre_m();
    if (box_of(patch, pass.state.now.position_m).exteriorDistance(centre_W) > bone.field.radius_m()) continue;
    for (const BonePatch::Node& node : patch.nodes) add_node(pass, bone, node);
  }
}

}  // namespace myotact::simulation
