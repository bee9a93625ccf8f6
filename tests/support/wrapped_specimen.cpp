#include "support/wrapped_specimen.h"

#include <algorithm>
#include <cmath>

namespace myotact::testing {
namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// Where a bar's material is that lies `along` it from its middle and `height_m` off the cylinder, and its direction.
struct Place {
  Vec3 position_m, direction;
};

Place place_on(const WrappedBar& bar, double along_m, double across_m, double height_m) {
  const double arc_m = bar.half_arc_rad * bar.moment_arm_m();
  const double angle = std::clamp(along_m, -arc_m, arc_m) / bar.moment_arm_m();
  const double beyond_m = along_m - std::clamp(along_m, -arc_m, arc_m);
  const Vec3 outward(std::sin(angle), 0.0, bar.side * std::cos(angle));
  const Vec3 forward(std::cos(angle), 0.0, -bar.side * std::sin(angle));
  return {(bar.radius_m + height_m) * outward + beyond_m * forward + Vec3(0.0, across_m, 0.0), forward};
}

anatomy::Muscle wrapped_muscle(const std::string& key, const WrappedBar& bar) {
  const double section_m2 = bar.width_m * bar.thickness_m, half_m = 0.5 * bar.length_m();
  anatomy::Muscle muscle;
  muscle.key = key;
  muscle.name_la = "musculus " + key;
  muscle.name_en = key + " muscle";
  muscle.material = "muscle";
  muscle.peak_force_N = 300e3 * section_m2;
  muscle.optimal_fibre_m = bar.length_m() / muscle.rest_stretch;
  muscle.estimated = {"rest_stretch"};
  muscle.sources = {"synthetic"};
  // z rises with z on both sides: the mirror image of a tet would be inside out.
  const Vec3 low_m(-half_m, -0.5 * bar.width_m, bar.side > 0.0 ? 0.0 : -bar.thickness_m);
  muscle.tets = box_mesh(low_m, {bar.length_m(), bar.width_m, bar.thickness_m}, bar.cells);
  const auto bend = [&](const Vec3& p) { return place_on(bar, p.x(), p.y(), bar.side * p.z()); };
  for (const auto& tet : muscle.tets.corners) {
    Vec3 middle_m = Vec3::Zero();
    for (int corner : tet) middle_m += muscle.tets.nodes_m[index(corner)] / 4.0;
    muscle.fibres.push_back(bend(middle_m).direction);
    muscle.sections_m2.push_back(section_m2);
    muscle.regions.push_back(anatomy::TissueRegion::Belly);
  }
  const double tolerance_m = 1e-9;
  for (Vec3& node : muscle.tets.nodes_m) {
    muscle.attachments.push_back(node.x() < tolerance_m - half_m ? 0 : node.x() > half_m - tolerance_m ? 1 : -1);
    node = bend(node).position_m;
  }
  muscle.skin = boundary_surface(muscle.tets);
  return muscle;
}

/// On the middle of the section up to where it leaves the arc; from there straight to the insertion, with the moment
/// arm of the arc.
anatomy::MuscleLine wrapped_line(int muscle, const WrappedBar& bar) {
  using anatomy::LinePointKind;
  anatomy::MuscleLine line;
  line.muscle = muscle;
  const double half_m = 0.5 * bar.length_m(), arc_m = half_m - bar.straight_m;
  const auto at = [&](double along_m) { return place_on(bar, along_m, 0.0, 0.5 * bar.thickness_m).position_m; };
  line.points.push_back({0, at(-half_m), LinePointKind::Origin});
  for (int k = -4; k <= 4; ++k) line.points.push_back({0, at(0.25 * k * arc_m), LinePointKind::Via});
  line.points.push_back({1, at(half_m), LinePointKind::Insertion});
  return line;
}

}  // namespace

geometry::TriangleMesh cylinder_surface(const Vec3& centre_m, double radius_m, double length_m) {
  constexpr int kSides = 96;
  geometry::TriangleMesh mesh;
  for (const double end : {-0.5, 0.5}) {
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2.0 * 3.14159265358979323846 * k / kSides;
      mesh.positions_m.push_back(centre_m +
                                 Vec3(radius_m * std::sin(angle), end * length_m, radius_m * std::cos(angle)));
    }
  }
  mesh.positions_m.push_back(centre_m - Vec3(0.0, 0.5 * length_m, 0.0));
  mesh.positions_m.push_back(centre_m + Vec3(0.0, 0.5 * length_m, 0.0));
  for (int k = 0; k < kSides; ++k) {
    const int next = (k + 1) % kSides;
    mesh.triangles.push_back({k, next, kSides + k});
    mesh.triangles.push_back({next, kSides + next, kSides + k});
    mesh.triangles.push_back({2 * kSides, next, k});
    mesh.triangles.push_back({2 * kSides + 1, kSides + k, kSides + next});
  }
  if (geometry::enclosed_volume_m3(mesh) < 0.0) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

anatomy::Specimen wrapped_hinge(const WrappedBar& bar, bool pair) {
  anatomy::Specimen specimen = hinged_bones();
  specimen.bones.resize(1);
  specimen.bones[0].surface = cylinder_surface(Vec3::Zero(), bar.radius_m, 2.0 * bar.width_m);
  specimen.joints[0].stiffness_Nm_rad = 0.0;
  WrappedBar under = bar;
  under.side = -1.0;
  specimen.muscles = {wrapped_muscle("flexor", bar)};
  specimen.lines = {wrapped_line(0, bar)};
  specimen.groups = {{0, {0}, {}}};
  if (!pair) return specimen;
  specimen.muscles.push_back(wrapped_muscle("extensor", under));
  specimen.lines.push_back(wrapped_line(1, under));
  specimen.groups = {{0, {0}, {1}}};
  return specimen;
}

}  // namespace myotact::testing
