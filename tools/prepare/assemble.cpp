#include "prepare/assemble.h"

#include <algorithm>

#include "core/error.h"

namespace myotact::prepare {

namespace {

const NamedSurface* find_surface(const std::vector<NamedSurface>& surfaces, const std::string& key) {
  const auto found =
      std::find_if(surfaces.begin(), surfaces.end(), [&](const NamedSurface& surface) { return surface.key == key; });
  return found == surfaces.end() ? nullptr : &*found;
}

std::vector<int> muscles_of(const anatomy::Specimen& specimen, const std::vector<std::string>& keys) {
  std::vector<int> muscles;
  for (const std::string& key : keys) {
    if (const int m = anatomy::find_muscle(specimen, key); m >= 0) muscles.push_back(m);
  }
  return muscles;
}

void add_bones(const PreparedInput& input, anatomy::Specimen& specimen, std::vector<SurfaceReport>& reports) {
  for (const BoneData& data : input.anatomy.bones) {
    const NamedSurface* raw = find_surface(input.bones, data.key);
    if (!raw) continue;
    specimen.bones.push_back(
        {data.key, data.name_la, data.name_en, data.body, prepare_bone(*raw, reports.emplace_back())});
  }
  if (specimen.bones.empty()) {
    throw Error(ExitStatus::BadData, "bones: none of the input's is named in the anatomy files; rename the surfaces");
  }
}

void add_muscles(const PreparedInput& input, const PrepareSettings& settings, anatomy::Specimen& specimen,
                 std::vector<SurfaceReport>& reports) {
  const LimbContext limb{input.anatomy, specimen.bones, settings};
  for (const MuscleData& data : input.anatomy.muscles) {
    const NamedSurface* raw = find_surface(input.muscles, data.mechanics.key);
    if (!raw) continue;
    PreparedMuscle prepared = prepare_muscle(limb, data, raw->surface, reports.emplace_back());
    prepared.line.muscle = static_cast<int>(specimen.muscles.size());
    specimen.muscles.push_back(std::move(prepared.muscle));
    specimen.lines.push_back(std::move(prepared.line));
  }
  if (specimen.muscles.empty()) {
    throw Error(ExitStatus::BadData, "muscles: none of the input's is named in the anatomy files; rename the surfaces");
  }
}

}  // namespace

anatomy::Specimen assemble_specimen(const PreparedInput& input, const PrepareSettings& settings,
                                    std::vector<SurfaceReport>& reports) {
  anatomy::Specimen specimen;
  specimen.name = input.anatomy.name;
  specimen.species = input.anatomy.species;
  specimen.breed = input.anatomy.breed;
  specimen.side = input.anatomy.side;
  specimen.source = input.anatomy.source;
  specimen.licence = input.anatomy.licence;
  specimen.created_by = "myotact-prepare";
  specimen.bodies = input.anatomy.bodies;
  specimen.joints = input.anatomy.joints;
  add_bones(input, specimen, reports);
  add_muscles(input, settings, specimen, reports);
  for (const GroupData& group : input.anatomy.groups) {
    anatomy::MuscleGroup present{group.joint, muscles_of(specimen, group.flexors),
                                 muscles_of(specimen, group.extensors)};
    if (!present.flexors.empty() || !present.extensors.empty()) specimen.groups.push_back(std::move(present));
  }
  if (const std::string defect = anatomy::find_defect(specimen); !defect.empty()) {
    throw Error(ExitStatus::BadData, defect);
  }
  return specimen;
}

}  // namespace myotact::prepare
