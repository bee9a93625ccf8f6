#include "support/synthetic_specimen.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace myotact::testing {
namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// The six tets of a cell: one for each order in which the axes are walked from the lowest to the highest corner.
constexpr std::array<std::array<int, 3>, 6> kAxisOrders = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};

std::array<int, 3> sorted(std::array<int, 3> face) {
  std::sort(face.begin(), face.end());
  return face;
}

anatomy::Bone box_bone(const std::string& key, int body, const Vec3& low_m, const Vec3& size_m) {
  anatomy::Bone bone;
  bone.key = key;
  bone.name_la = "os " + key;
  bone.name_en = key + " bone";
  bone.body = body;
  bone.surface = boundary_surface(box_mesh(low_m, size_m, {8, 1, 1}));
  return bone;
}

anatomy::Body rod(const std::string& key, const Vec3& com_m) {
  anatomy::Body body;
  body.key = key;
  body.mass_kg = 0.2;
  body.com_m = com_m;
  const double length_m = 0.2;
  const double across = body.mass_kg * length_m * length_m / 12.0;  // a thin rod along x
  body.inertia_kg_m2 = {1e-5, across, across, 0.0, 0.0, 0.0};
  return body;
}

}  // namespace

geometry::TetMesh box_mesh(const Vec3& origin_m, const Vec3& size_m, const std::array<int, 3>& cells) {
  geometry::TetMesh mesh;
  const auto node = [&](int i, int j, int k) { return i + (cells[0] + 1) * (j + (cells[1] + 1) * k); };
  for (int k = 0; k <= cells[2]; ++k) {
    for (int j = 0; j <= cells[1]; ++j) {
      for (int i = 0; i <= cells[0]; ++i) {
        mesh.nodes_m.push_back(origin_m +
                               Vec3(size_m.x() * i / cells[0], size_m.y() * j / cells[1], size_m.z() * k / cells[2]));
      }
    }
  }
  for (int cell = 0; cell < cells[0] * cells[1] * cells[2]; ++cell) {
    const std::array<int, 3> low{cell % cells[0], cell / cells[0] % cells[1], cell / (cells[0] * cells[1])};
    for (std::size_t order = 0; order < kAxisOrders.size(); ++order) {
      std::array<int, 3> at = low;
      std::array<int, 4> tet{node(at[0], at[1], at[2]), 0, 0, 0};
      for (std::size_t step = 0; step < 3; ++step) {
        ++at[index(kAxisOrders[order][step])];
        tet[step + 1] = node(at[0], at[1], at[2]);
      }
      if (order >= 3) std::swap(tet[1], tet[2]);  // odd permutations are mirror images
      mesh.corners.push_back(tet);
    }
  }
  return mesh;
}

geometry::TriangleMesh boundary_surface(const geometry::TetMesh& mesh) {
  static constexpr std::array<std::array<int, 3>, 4> kFaces = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  std::map<std::array<int, 3>, int> uses;
  for (const auto& tet : mesh.corners) {
    for (const auto& f : kFaces) ++uses[sorted({tet[index(f[0])], tet[index(f[1])], tet[index(f[2])]})];
  }
  geometry::TriangleMesh surface;
  std::map<int, int> vertex_of_node;
  for (const auto& tet : mesh.corners) {
    for (const auto& f : kFaces) {
      const std::array<int, 3> nodes{tet[index(f[0])], tet[index(f[1])], tet[index(f[2])]};
      if (uses[sorted(nodes)] != 1) continue;
      std::array<int, 3> triangle{};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [found, added] = vertex_of_node.try_emplace(nodes[c], static_cast<int>(surface.positions_m.size()));
        if (added) surface.positions_m.push_back(mesh.nodes_m[index(nodes[c])]);
        triangle[c] = found->second;
      }
      surface.triangles.push_back(triangle);
    }
  }
  return surface;
}

anatomy::Muscle bar_muscle(const std::string& key, const BarShape& shape) {
  const Vec3 low_m = shape.origin_m - Vec3(0.0, shape.width_m / 2.0, shape.width_m / 2.0);
  const Vec3 size_m(shape.length_m, shape.width_m, shape.width_m);
  const double section_m2 = shape.width_m * shape.width_m;
  const double end_m = low_m.x() + shape.length_m;
  const double belly_m = shape.length_m * (shape.cells[0] - shape.tendon_cells) / shape.cells[0];
  anatomy::Muscle muscle;
  muscle.key = key;
  muscle.name_la = "musculus " + key;
  muscle.name_en = key + " muscle";
  muscle.material = "muscle";
  muscle.peak_force_N = 300e3 * section_m2;  // 300 kPa: the usual specific tension
  muscle.optimal_fibre_m = belly_m / muscle.rest_stretch;
  muscle.estimated = {"rest_stretch"};
  muscle.sources = {"synthetic"};
  muscle.tets = box_mesh(low_m, size_m, shape.cells);
  for (const auto& tet : muscle.tets.corners) {
    double middle_m = 0.0;
    for (int corner : tet) middle_m += muscle.tets.nodes_m[index(corner)].x() / 4.0;
    const bool tendon = middle_m > low_m.x() + belly_m;
    muscle.fibres.push_back(Vec3::UnitX());
    muscle.sections_m2.push_back(section_m2);
    muscle.regions.push_back(tendon ? anatomy::TissueRegion::Tendon : anatomy::TissueRegion::Belly);
  }
  const double tolerance_m = 1e-9;
  for (const Vec3& node : muscle.tets.nodes_m) {
    const bool at_origin = node.x() < low_m.x() + tolerance_m;
    const bool at_insertion = node.x() > end_m - tolerance_m;
    muscle.attachments.push_back(at_origin ? 0 : at_insertion ? 1 : -1);
  }
  muscle.skin = boundary_surface(box_mesh(low_m, size_m, {2 * shape.cells[0], 2 * shape.cells[1], 2 * shape.cells[2]}));
  return muscle;
}

anatomy::MuscleLine bar_line(int muscle, const BarShape& shape) {
  using anatomy::LinePointKind;
  const double belly_m = shape.length_m * (shape.cells[0] - shape.tendon_cells) / shape.cells[0];
  anatomy::MuscleLine line;
  line.muscle = muscle;
  line.points.push_back({0, shape.origin_m, LinePointKind::Origin});
  if (shape.tendon_cells > 0) {
    const int body = shape.origin_m.x() + belly_m > 0.0 ? 1 : 0;  // the hinge is at x = 0
    line.points.push_back({body, shape.origin_m + Vec3(belly_m, 0.0, 0.0), LinePointKind::Via});
  }
  line.points.push_back({1, shape.origin_m + Vec3(shape.length_m, 0.0, 0.0), LinePointKind::Insertion});
  return line;
}

anatomy::Specimen hinged_bones() {
  anatomy::Specimen specimen;
  specimen.name = "synthetic hinge";
  specimen.species = "none";
  specimen.side = "left";
  specimen.source = specimen.created_by = "tests";
  specimen.licence = "Apache-2.0";
  specimen.bodies = {rod("upper", {-0.1, 0.0, 0.0}), rod("lower", {0.1, 0.0, 0.0})};
  specimen.bones = {box_bone("upper", 0, {-0.2, -0.008, -0.008}, {0.195, 0.016, 0.016}),
                    box_bone("lower", 1, {0.005, -0.008, -0.008}, {0.195, 0.016, 0.016})};
  anatomy::Joint joint;
  joint.key = "elbow";
  joint.type = anatomy::JointType::Hinge;
  joint.parent = 0;
  joint.child = 1;
  joint.axes = {-Vec3::UnitY()};
  joint.range_rad = {{-0.6, 1.5}};
  joint.stiffness_Nm_rad = 6.0;  // outweighs the straight lines' destabilising part up to half activation
  joint.damping_Nms_rad = 0.02;
  specimen.joints = {joint};
  return specimen;
}

anatomy::Specimen antagonist_hinge() {
  anatomy::Specimen specimen = hinged_bones();
  const BarShape flexor;
  BarShape extensor;
  extensor.origin_m.z() = -flexor.origin_m.z();
  specimen.muscles = {bar_muscle("flexor", flexor), bar_muscle("extensor", extensor)};
  specimen.lines = {bar_line(0, flexor), bar_line(1, extensor)};
  specimen.groups = {{0, {0}, {1}}};
  return specimen;
}

anatomy::Specimen coarse_antagonist_hinge() {
  anatomy::Specimen specimen = antagonist_hinge();
  BarShape coarse;
  coarse.cells = {4, 1, 1};
  specimen.muscles[0] = bar_muscle("flexor", coarse);
  coarse.origin_m.z() *= -1.0;
  specimen.muscles[1] = bar_muscle("extensor", coarse);
  return specimen;
}

anatomy::Specimen single_muscle(const BarShape& shape) {
  anatomy::Specimen specimen = hinged_bones();
  specimen.muscles = {bar_muscle("flexor", shape)};
  specimen.lines = {bar_line(0, shape)};
  specimen.groups = {{0, {0}, {}}};
  return specimen;
}

}  // namespace myotact::testing
