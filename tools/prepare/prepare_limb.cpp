#include "prepare/prepare_limb.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "core/error.h"
#include "prepare/stages/stages.h"

namespace myotact::prepare {

namespace {

struct Stage {
  const char* name;
  void (*run)(LimbWork&, const PartDone&);
  bool with_bones;   // bones are parts of it, too
  bool for_volumes;  // parts that were cut from a volume need it, too
  double share;      // of the whole time, measured on the canine forelimb
};

constexpr std::array<Stage, 8> kStages = {{{"repair", repair_surfaces, true, false, 0.02},
                                           {"part", part_muscles, false, false, 0.30},
                                           {"remesh", remesh_surfaces, true, false, 0.40},
                                           {"tetrahedralise", fill_cages, false, true, 0.20},
                                           {"attach", attach_muscles, false, true, 0.01},
                                           {"fibres", lay_fibres, false, true, 0.01},
                                           {"lines", trace_lines, false, true, 0.01},
                                           {"skins", settle_skins, false, false, 0.05}}};

std::vector<int> muscles_of(const anatomy::Specimen& specimen, const std::vector<std::string>& keys) {
  std::vector<int> muscles;
  for (const std::string& key : keys) {
    if (const int m = anatomy::find_muscle(specimen, key); m >= 0) muscles.push_back(m);
  }
  return muscles;
}

/// Marks the nodes of all patches with their bodies.
std::vector<int> attach_nodes(const MuscleWork& muscle) {
  std::vector<int> attachments(muscle.cage.tets.nodes_m.size(), -1);
  const auto mark = [&](const AttachmentPatches& patches, const std::vector<int>& bodies) {
    for (std::size_t i = 0; i < patches.size(); ++i) {
      for (const int v : patches[i].vertices) attachments[static_cast<std::size_t>(v)] = bodies[i];
    }
  };
  mark(muscle.origins, muscle.origin_bodies);
  mark(muscle.insertions, muscle.insertion_bodies);
  return attachments;
}

void add_muscle(const MuscleWork& work, anatomy::Specimen& specimen) {
  anatomy::Muscle muscle = work.data.mechanics;
  muscle.tets = work.cage.tets;
  muscle.fibres = work.fibres.direction;
  muscle.sections_m2 = work.profile.tet_section_m2;
  muscle.regions = mark_regions(work.profile, work.belly);
  if (muscle.pennation_rad > 0.0) {
    mark_aponeuroses(work.cage.tets, work.origins, muscle.regions);
    mark_aponeuroses(work.cage.tets, work.insertions, muscle.regions);
  }
  muscle.attachments = attach_nodes(work);
  muscle.skin = work.skin;
  anatomy::MuscleLine line = work.line;
  line.muscle = static_cast<int>(specimen.muscles.size());
  specimen.muscles.push_back(std::move(muscle));
  specimen.lines.push_back(std::move(line));
}

anatomy::Specimen collect(const LimbWork& limb) {
  const AnatomyData& anatomy = limb.anatomy;
  anatomy::Specimen specimen;
  specimen.name = anatomy.name;
  specimen.species = anatomy.species;
  specimen.breed = anatomy.breed;
  specimen.side = anatomy.side;
  specimen.source = anatomy.source;
  specimen.licence = anatomy.licence;
  specimen.created_by = "myotact-prepare";
  specimen.bodies = anatomy.bodies;
  specimen.joints = anatomy.joints;
  for (const BoneWork& bone : limb.bones) {
    specimen.bones.push_back({bone.data.key, bone.data.name_la, bone.data.name_en, bone.data.body, bone.skin});
  }
  for (const MuscleWork& muscle : limb.muscles) add_muscle(muscle, specimen);
  for (const GroupData& group : anatomy.groups) {
    anatomy::MuscleGroup present{group.joint, muscles_of(specimen, group.flexors),
                                 muscles_of(specimen, group.extensors)};
    if (!present.flexors.empty() || !present.extensors.empty()) specimen.groups.push_back(std::move(present));
  }
  specimen.overlaps = limb.overlaps;
  return specimen;
}

}  // namespace

std::vector<std::string> stage_names() {
  std::vector<std::string> names;
  for (const Stage& stage : kStages) names.emplace_back(stage.name);
  return names;
}

void run_stages(LimbWork& limb, const std::string& last, const OnProgress& on_progress) {
  double before = 0.0;
  for (const Stage& stage : kStages) {
    if (limb.shares_borders && !stage.for_volumes) {
      before += stage.share;
      if (stage.name == last) return;
      continue;
    }
    std::mutex mutex;
    Progress progress{stage.name, 0, static_cast<int>(limb.muscles.size()), before};
    if (stage.with_bones) progress.parts += static_cast<int>(limb.bones.size());
    const auto report = [&] {
      if (on_progress) on_progress(progress);
    };
    report();
    const auto start = std::chrono::steady_clock::now();
    stage.run(limb, [&] {
      const std::lock_guard lock(mutex);
      ++progress.done;
      progress.whole = before + stage.share * std::min(1.0, static_cast<double>(progress.done) / progress.parts);
      report();
    });
    limb.stage_seconds.emplace_back(stage.name,
                                    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (stage.name == last) return;
    before += stage.share;
  }
}

anatomy::Specimen prepare_limb(LimbWork& limb, const OnProgress& on_progress) {
  run_stages(limb, kStages.back().name, on_progress);
  anatomy::Specimen specimen = collect(limb);
  if (const std::string defect = anatomy::find_defect(specimen); !defect.empty()) {
    throw Error(ExitStatus::BadData, "check: " + defect);
  }
  return specimen;
}

}  // namespace myotact::prepare
