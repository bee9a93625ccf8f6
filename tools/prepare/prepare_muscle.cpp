#include "prepare/prepare_muscle.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "geometry/triangle_tree.h"
#include "prepare/architecture/attachment_patch.h"
#include "prepare/architecture/fibre_field.h"
#include "prepare/architecture/muscle_line.h"
#include "prepare/architecture/sections.h"
#include "prepare/remesh/cage.h"
#include "prepare/repair/surface_check.h"
#include "prepare/repair/surface_pieces.h"
#include "prepare/tets/tetrahedralise.h"

namespace myotact::prepare {

namespace {

using anatomy::Bone;
using geometry::TriangleMesh;

/// The volume at which a muscle gets the number of tets of the settings [m3]: the biceps of a middle-sized dog.
constexpr double kUsualVolume_m3 = 30e-6;
/// Range of that number around the settings': small muscles still need two patches and a belly between.
constexpr double kFewestTets = 0.4;
constexpr double kMostTets = 1.25;
/// A bone's skin has about at most this many triangles.
constexpr double kBoneTriangles = 1400.0;
/// Sesamoid bones have half a hundredth of the area of their paw; specks of a scan are smaller.
constexpr double kBoneDebris = 1e-3;
/// Tets with a smaller angle make the solver stiff.
constexpr double kPoorDihedral_deg = 5.0;
constexpr double kBadDihedral_deg = 1.0;

class Watch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

double tets_for(double volume_m3, const PrepareSettings& settings) {
  return settings.tets * std::clamp(std::cbrt(volume_m3 / kUsualVolume_m3), kFewestTets, kMostTets);
}

/// The body that carries the bones of a site, and their surfaces joined.
PatchGuide guide_for(const LimbContext& limb, const std::string& name, const AttachmentSite& site, int& body) {
  PatchGuide guide;
  guide.point_m = site.point_m;
  guide.area_m2 = site.area_m2;
  body = -1;
  for (const Bone& bone : limb.bones) {
    if (std::find(site.bones.begin(), site.bones.end(), bone.key) == site.bones.end()) continue;
    append(guide.bones, bone.surface);
    if (body >= 0 && body != bone.body) {
      throw bad_data(name, "attachments", "the bones of one end lie on two bodies; name bones of one body");
    }
    body = bone.body;
  }
  if (body < 0) throw bad_data(name, "attachments", "none of the bones it is fixed to is in the specimen; add one");
  return guide;
}

Vec3 on_bone(const PatchGuide& guide, const Vec3& p) {
  return geometry::TriangleTree(guide.bones).nearest(p, guide.bones.positions_m).point.position_m;
}

TriangleMesh repaired(const std::string& key, const TriangleMesh& raw, const RepairSettings& settings,
                      SurfaceReport& report) {
  check_size(key, raw);
  RepairResult result = repair_surface(key, raw, settings);
  report.repairs = std::move(result.steps);
  report.moved_m = result.hausdorff_m;
  return std::move(result.mesh);
}

TriangleMesh clean_muscle(const MuscleData& data, const TriangleMesh& raw, SurfaceReport& report) {
  const std::string& key = data.mechanics.key;
  report.key = key;
  report.muscle = true;
  report.input_triangles = static_cast<int>(raw.triangles.size());
  TriangleMesh surface = repaired(key, raw, {}, report);
  report.volume_m3 = geometry::enclosed_volume_m3(surface);
  return surface;
}

void check_quality(const std::string& name, SurfaceReport& report) {
  const double angle_deg = report.tets.smallest_dihedral_deg;
  if (angle_deg < kBadDihedral_deg) {
    throw bad_data(name, "tetrahedra",
                   fmt::format("the smallest angle is {:.2f} degrees; must be at least {:.0f}. Ask for more tets",
                               angle_deg, kBadDihedral_deg));
  }
  if (angle_deg < kPoorDihedral_deg) report.notes.push_back(fmt::format("flat tet, {:.1f} degrees", angle_deg));
}

/// Marks the nodes of both patches with their bodies.
std::vector<int> attach_nodes(std::size_t nodes, const AttachmentPatch& origin, const AttachmentPatch& insertion,
                              const LineBones& bones) {
  std::vector<int> attachments(nodes, -1);
  for (const int v : origin.vertices) attachments[static_cast<std::size_t>(v)] = bones.origin_body;
  for (const int v : insertion.vertices) attachments[static_cast<std::size_t>(v)] = bones.insertion_body;
  return attachments;
}

void report_line(const LimbContext& limb, const anatomy::MuscleLine& line, const LineBones& bones,
                 SurfaceReport& report) {
  for (const int j : joints_between(report.key, bones)) {
    const anatomy::Joint& joint = limb.anatomy.joints[static_cast<std::size_t>(j)];
    if (joint.type != anatomy::JointType::Hinge) continue;
    report.levers_m.emplace_back(joint.key, moment_arm_m(line, joint, bones));
  }
}

}  // namespace

PreparedMuscle prepare_muscle(const LimbContext& limb, const MuscleData& data, const TriangleMesh& raw,
                              SurfaceReport& report) {
  const Watch watch;
  PreparedMuscle result{data.mechanics, {}};
  const std::string& key = data.mechanics.key;
  const TriangleMesh surface = clean_muscle(data, raw, report);
  result.muscle.skin = even_surface(key, surface, kSkinEdge_m).mesh;
  report.skin_triangles = static_cast<int>(result.muscle.skin.triangles.size());

  const double tets = tets_for(report.volume_m3, limb.settings);
  const EvenSurface cage = even_surface(key, surface, edge_for_tets_m(report.volume_m3, tets));
  report.cage_attempts = cage.attempts;
  report.cage_volume_error = cage.volume_error;
  result.muscle.tets = tetrahedralise(key, cage.mesh);
  report.tets = measure_tets(result.muscle.tets);
  check_quality(key, report);

  LineBones bones{limb.anatomy.bodies, limb.anatomy.joints};
  const PatchGuide origin_guide = guide_for(limb, key, data.origin, bones.origin_body);
  const PatchGuide insertion_guide = guide_for(limb, key, data.insertion, bones.insertion_body);
  const AttachmentPatch insertion = grow_patch(key, cage.mesh, insertion_guide);
  const AttachmentPatch origin = grow_patch(key, cage.mesh, origin_guide, insertion.triangles);
  result.muscle.attachments = attach_nodes(result.muscle.tets.nodes_m.size(), origin, insertion, bones);
  report.origin_area_m2 = origin.area_m2;
  report.insertion_area_m2 = insertion.area_m2;
  report.origin_gap_m = origin.bone_distance_m;
  report.insertion_gap_m = insertion.bone_distance_m;

  const FibreField field = solve_fibres(key, result.muscle.tets, cage.mesh, origin, insertion);
  const MuscleProfile profile = slice_muscle(result.muscle.tets, field);
  const BellySpan belly = find_belly(profile);
  result.muscle.fibres = field.direction;
  result.muscle.sections_m2 = profile.tet_section_m2;
  result.muscle.regions = mark_regions(profile, belly);
  report.filled_tets = field.filled_tets;
  report.fibre_angle_deg = field.mean_angle_to_axis_deg;
  report.path_m = profile.length_m;
  report.belly_m = belly.end_m - belly.begin_m;
  report.largest_section_m2 = *std::max_element(profile.section_m2.begin(), profile.section_m2.end());

  // The line ends where the attachment was measured, not at the patch: the cage may have lost a thin tip.
  const LineEnds ends{on_bone(origin_guide, origin_guide.point_m), on_bone(insertion_guide, insertion_guide.point_m)};
  result.line = trace_line(key, profile, belly, ends, bones);
  report_line(limb, result.line, bones, report);
  report.wall_s = watch.seconds();
  return result;
}

TriangleMesh prepare_bone(const NamedSurface& raw, SurfaceReport& report) {
  const Watch watch;
  report.key = raw.key;
  report.input_triangles = static_cast<int>(raw.surface.triangles.size());
  RepairSettings settings;
  settings.several_bodies = true;
  settings.debris = kBoneDebris;
  const TriangleMesh surface = repaired(raw.key, raw.surface, settings, report);
  report.volume_m3 = geometry::enclosed_volume_m3(surface);
  // Equilateral triangles of edge h have area sqrt(3)/4 h^2.
  const double budget_m = std::sqrt(geometry::surface_area_m2(surface) / kBoneTriangles * 4.0 / std::sqrt(3.0));
  TriangleMesh result;
  int kept = 0;
  for (const TriangleMesh& piece : pieces_of(surface)) {  // the bones of a paw may overlap each other
    try {
      append(result, even_surface(raw.key, piece, std::max(budget_m, kSkinEdge_m)).mesh);
    } catch (const Error&) {  // thin blades and hooks: rigid, so uneven triangles do no harm
      append(result, piece);
      ++kept;
    }
  }
  if (kept > 0) report.notes.push_back(fmt::format("{} pieces kept as they are: too thin for even triangles", kept));
  report.skin_triangles = static_cast<int>(result.triangles.size());
  report.wall_s = watch.seconds();
  return result;
}

}  // namespace myotact::prepare
