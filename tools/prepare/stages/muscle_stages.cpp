#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "geometry/triangle_tree.h"
#include "prepare/architecture/muscle_line.h"
#include "prepare/field/local_radius.h"
#include "prepare/parallel.h"
#include "prepare/stages/stages.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

/// Tets with a smaller angle make the solver stiff: worth a note, and refused.
constexpr double kPoorDihedral_deg = 5.0;
constexpr double kBadDihedral_deg = 1.0;

template <class Task>
void for_each_muscle(LimbWork& limb, const PartDone& done, Task&& task) {
  for_each_index(limb.muscles.size(), limb.settings.threads, [&](std::size_t m) {
    task(limb.muscles[m]);
    done();
  });
}

/// The body that carries a site, and the surfaces of its bones, joined.
PatchGuide guide_for(const LimbWork& limb, const std::string& name, const AttachmentSite& site, int& body) {
  PatchGuide guide;
  guide.point_m = site.point_m;
  guide.area_m2 = site.area_m2;
  body = site.body;
  for (const BoneWork& bone : limb.bones) {
    if (std::find(site.bones.begin(), site.bones.end(), bone.data.key) == site.bones.end()) continue;
    append(guide.bones, bone.skin);
    if (body >= 0 && body != bone.data.body) {
      throw bad_data(name, "attachments", "the bones of one site lie on two bodies; name bones of one body");
    }
    body = bone.data.body;
  }
  if (body < 0) throw bad_data(name, "attachments", "none of the bones it is fixed to is in the specimen; add one");
  return guide;
}

/// One end of a muscle, as it is found.
struct AttachedEnd {
  AttachmentPatches patches;
  std::vector<int> bodies;
  std::vector<int> triangles;  // of all patches
};

AttachedEnd attach_end(const LimbWork& limb, MuscleWork& muscle, const std::vector<AttachmentSite>& sites,
                       const std::vector<int>& other_end) {
  const std::string& name = muscle.data.mechanics.key;
  AttachedEnd end;
  int without_room = 0;
  for (const AttachmentSite& site : sites) {
    int body = -1;
    PatchGuide guide = guide_for(limb, name, site, body);
    guide.sites = static_cast<int>(sites.size());
    guide.covered = end.triangles;
    AttachmentPatch patch = grow_patch(name, muscle.cage.surface, guide, other_end);
    if (patch.triangles.empty()) {
      ++without_room;
      continue;
    }
    end.triangles.insert(end.triangles.end(), patch.triangles.begin(), patch.triangles.end());
    end.patches.push_back(std::move(patch));
    end.bodies.push_back(body);
  }
  if (without_room > 0) {
    muscle.report.notes.push_back(
        fmt::format("{} of {} sites of one end found no room of their own on the cage", without_room, sites.size()));
  }
  return end;
}

void report_end(const AttachmentPatches& patches, double& area_m2, double& gap_m) {
  for (const AttachmentPatch& patch : patches) {
    area_m2 += patch.area_m2;
    gap_m = std::max(gap_m, patch.bone_distance_m);
  }
}

void check_quality(const std::string& name, SurfaceReport& report) {
  const double angle_deg = report.tets.smallest_dihedral_deg;
  if (angle_deg < kBadDihedral_deg) {
    throw bad_data(name, "tetrahedra",
                   fmt::format("the smallest angle is {:.2f} degrees; must be at least {:.0f}. Ask for more tets",
                               angle_deg, kBadDihedral_deg));
  }
  report.marks.push_back({MarkKind::Tet, report.tets.flattest_m});
  if (angle_deg < kPoorDihedral_deg) report.notes.push_back(fmt::format("flat tet, {:.1f} degrees", angle_deg));
}

void mark_ends(MuscleWork& muscle) {
  const auto mark = [&](const AttachmentPatches& patches, MarkKind kind) {
    for (const AttachmentPatch& patch : patches) {
      Vec3 middle_m = Vec3::Zero();
      for (const int v : patch.vertices) middle_m += muscle.cage.surface.positions_m[static_cast<std::size_t>(v)];
      muscle.report.marks.push_back({kind, middle_m / static_cast<double>(patch.vertices.size())});
    }
  };
  mark(muscle.origins, MarkKind::Origin);
  mark(muscle.insertions, MarkKind::Insertion);
}

/// The point of the bones nearest to the site's, or the site's own point where no bone carries it.
Vec3 line_end_m(const LimbWork& limb, const std::string& name, const AttachmentSite& site) {
  int body = -1;
  const PatchGuide guide = guide_for(limb, name, site, body);
  if (guide.bones.triangles.empty()) return site.point_m;
  return geometry::TriangleTree(guide.bones).nearest(site.point_m, guide.bones.positions_m).point.position_m;
}

}  // namespace

void fill_cages(LimbWork& limb, const PartDone& done) {
  for_each_muscle(limb, done, [&](MuscleWork& muscle) {
    const std::string& name = muscle.data.mechanics.key;
    muscle.cage = make_cage(name, muscle.surface, limb.settings.tets);
    muscle.report.tets = muscle.cage.quality;
    muscle.report.cage_attempts = muscle.cage.attempts;
    muscle.report.cage_volume_error = muscle.cage.volume_error;
    muscle.report.cage_deviation_m = muscle.cage.deviation_m;
    muscle.report.cage_edge_m = muscle.cage.edge_m;
    check_quality(name, muscle.report);
  });
}

void attach_muscles(LimbWork& limb, const PartDone& done) {
  for_each_muscle(limb, done, [&](MuscleWork& muscle) {
    AttachedEnd insertion = attach_end(limb, muscle, muscle.data.insertions, {});
    AttachedEnd origin = attach_end(limb, muscle, muscle.data.origins, insertion.triangles);
    muscle.insertions = std::move(insertion.patches);
    muscle.insertion_bodies = std::move(insertion.bodies);
    muscle.origins = std::move(origin.patches);
    muscle.origin_bodies = std::move(origin.bodies);
    report_end(muscle.origins, muscle.report.origin_area_m2, muscle.report.origin_gap_m);
    report_end(muscle.insertions, muscle.report.insertion_area_m2, muscle.report.insertion_gap_m);
    mark_ends(muscle);
  });
}

void lay_fibres(LimbWork& limb, const PartDone& done) {
  for_each_muscle(limb, done, [&](MuscleWork& muscle) {
    const std::string& name = muscle.data.mechanics.key;
    muscle.fibres = solve_fibres(name, muscle.cage.tets, muscle.cage.surface, muscle.origins, muscle.insertions);
    muscle.profile = slice_muscle(muscle.cage.tets, muscle.fibres);
    measure_radii(touching_balls(SignedDistance(muscle.surface)), muscle.cage.tets, muscle.profile);
    muscle.belly = find_belly(muscle.profile);
    SurfaceReport& report = muscle.report;
    report.filled_tets = muscle.fibres.filled_tets;
    report.fibre_angle_deg = muscle.fibres.mean_angle_to_axis_deg;
    report.path_m = muscle.profile.length_m;
    report.belly_m = muscle.belly.end_m - muscle.belly.begin_m;
    report.largest_section_m2 = *std::max_element(muscle.profile.section_m2.begin(), muscle.profile.section_m2.end());
  });
}

void trace_lines(LimbWork& limb, const PartDone& done) {
  for_each_muscle(limb, done, [&](MuscleWork& muscle) {
    const std::string& name = muscle.data.mechanics.key;
    const LineBones bones{limb.anatomy.bodies, limb.anatomy.joints, muscle.origin_bodies.front(),
                          muscle.insertion_bodies.front()};
    muscle.line = {-1, muscle.data.line, {}};
    if (muscle.line.points.empty()) {
      // The line ends where the attachment was measured, not at the patch: the cage may have lost a thin tip.
      const LineGuide guide{line_end_m(limb, name, muscle.data.origins.front()),
                            line_end_m(limb, name, muscle.data.insertions.front()), muscle.data.crossings,
                            muscle.middle_m};
      muscle.line = trace_line(name, muscle.profile, muscle.belly, guide, bones);
    }
    add_wraps(name, muscle.data.wraps, bones, muscle.line);
    for (const int j : joints_between(name, bones)) {
      const anatomy::Joint& joint = limb.anatomy.joints[static_cast<std::size_t>(j)];
      if (joint.type != anatomy::JointType::Hinge) continue;
      muscle.report.moment_arms_m.emplace_back(joint.key, moment_arm_m(muscle.line, joint, bones));
    }
  });
}

}  // namespace myotact::prepare
