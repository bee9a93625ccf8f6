#include <fmt/format.h>

#include "core/text.h"
#include "prepare/parallel.h"
#include "prepare/remesh/fine_surface.h"
#include "prepare/repair/repair_surface.h"
#include "prepare/repair/surface_check.h"
#include "prepare/stages/stages.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Calls task(part) for every bone and muscle.
template <class Task>
void for_each_part(LimbWork& limb, const PartDone& done, Task&& task) {
  const std::size_t bones = limb.bones.size();
  for_each_index(bones + limb.muscles.size(), limb.settings.threads, [&](std::size_t i) {
    if (i < bones)
      task(limb.bones[i]);
    else
      task(limb.muscles[i - bones]);
    done();
  });
}

/// Sesamoid bones have half a hundredth of the area of their paw; specks of a scan are smaller.
constexpr double kBoneDebris = 1e-3;
/// Of what parting cut loose and dropped [m3].
constexpr double kWorthANote_m3 = 1e-8;

void repair(const std::string& key, TriangleMesh& surface, const RepairSettings& settings, SurfaceReport& report) {
  report.key = key;
  report.input_triangles = static_cast<int>(surface.triangles.size());
  check_size(key, surface);
  RepairResult result = repair_surface(key, surface, settings);
  surface = std::move(result.mesh);
  report.repairs = std::move(result.steps);
  report.moved_m = result.hausdorff_m;
  for (const RepairStep& step : report.repairs) report.marks.push_back({MarkKind::Repair, step.place_m});
  report.volume_m3 = geometry::enclosed_volume_m3(surface);
}

/// Lets every piece of a bone become a skin of its own: those of a paw may overlap each other.
TriangleMesh bone_skin(const TriangleMesh& surface) {
  TriangleMesh skin;
  for (const TriangleMesh& piece : pieces_of(surface)) append(skin, skin_surface(fine_surface(piece)));
  return skin;
}

void report_parting(const PartReport& part, SurfaceReport& report) {
  report.parted_loss_m3 = part.volume_lost_m3;
  report.volume_m3 = part.volume_before_m3 - part.volume_lost_m3;
  for (const auto& [volume_m3, key] : part.gave_way) report.gave_way.emplace_back(key, volume_m3);
  if (!part.hosts.empty()) report.notes.push_back("nested in " + join(part.hosts) + ": keeps its shape");
  if (part.filmed)
    report.notes.push_back("neighbours reach through it: films close the holes, strands hold loose ends");
  if (part.added_genus > 0) report.notes.push_back(fmt::format("parting left {} holes through it", part.added_genus));
  if (part.kept_core) report.notes.push_back("would be cut in two by its neighbours: its core stays and overlaps them");
  if (part.dropped_m3 > kWorthANote_m3) {
    report.notes.push_back(fmt::format("{:.2f} cm3 of loose ends dropped in parting", 1e6 * part.dropped_m3));
  }
}

}  // namespace

void repair_surfaces(LimbWork& limb, const PartDone& done) {
  for_each_part(limb, done, [&](auto& part) {
    RepairSettings settings;
    settings.tolerance = limb.settings.tolerance;
    if constexpr (std::is_same_v<std::decay_t<decltype(part)>, BoneWork>) {
      settings.several_bodies = true;
      settings.debris = kBoneDebris;
      repair(part.data.key, part.surface, settings, part.report);
    } else {
      part.report.muscle = true;
      repair(part.data.mechanics.key, part.surface, settings, part.report);
    }
  });
}

void part_muscles(LimbWork& limb, const PartDone& done) {
  std::vector<NamedSurface> muscles, bones;
  for (MuscleWork& muscle : limb.muscles) muscles.push_back({muscle.data.mechanics.key, std::move(muscle.surface)});
  for (const BoneWork& bone : limb.bones) {
    for (TriangleMesh& piece : pieces_of(bone.surface)) bones.push_back({bone.data.key, std::move(piece)});
  }
  PartSettings settings;
  settings.threads = limb.settings.threads;
  const auto reports = part_surfaces(muscles, bones, settings, done);
  for (std::size_t m = 0; m < limb.muscles.size(); ++m) {
    limb.muscles[m].surface = std::move(muscles[m].surface);
    report_parting(reports[m], limb.muscles[m].report);
  }
}

void remesh_surfaces(LimbWork& limb, const PartDone& done) {
  for_each_part(limb, done, [](auto& part) {
    if constexpr (std::is_same_v<std::decay_t<decltype(part)>, BoneWork>) {
      part.skin = bone_skin(part.surface);
    } else {
      part.surface = fine_surface(part.surface);
      part.skin = skin_surface(part.surface);
    }
    part.report.skin_triangles = static_cast<int>(part.skin.triangles.size());
  });
}

}  // namespace myotact::prepare
