#include "simulation/contact/bone_contact.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "core/at.h"
#include "geometry/tet_topology.h"

namespace myotact::simulation {
namespace {

/// Cells of the bones' fields [m]: a fifth of a canine long bone's radius; smoothing then moves its surface by 0.02 mm.
constexpr double kFieldSpacing_m = 1e-3;

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

}  // namespace myotact::simulation
