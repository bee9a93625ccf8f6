#include "prepare/recipe/read_scan.h"

#include "core/error.h"
#include "core/text.h"
#include "geometry/mesh_files.h"

namespace myotact::prepare {

namespace {

/// The surfaces of the folder that carry one of the keys, in the keys' order.
std::vector<NamedSurface> read_named(const std::filesystem::path& folder, const std::vector<std::string>& keys) {
  if (!std::filesystem::is_directory(folder)) {
    throw Error(ExitStatus::NoInput, folder.string() + ": is not a folder; it must hold surfaces named KEY.stl");
  }
  std::vector<NamedSurface> surfaces;
  for (const std::string& key : keys) {
    const std::filesystem::path file = folder / (key + ".stl");
    if (std::filesystem::exists(file)) surfaces.push_back({key, geometry::read_stl(file)});
  }
  if (surfaces.empty()) {
    throw Error(ExitStatus::NoInput,
                folder.string() + ": holds none of the surfaces that the anatomy names: " + join(keys) + " (.stl)");
  }
  return surfaces;
}

}  // namespace

Scan read_scan(const std::filesystem::path& folder, const AnatomyData& anatomy) {
  std::vector<std::string> bones, muscles;
  for (const BoneData& bone : anatomy.bones) bones.push_back(bone.key);
  for (const MuscleData& muscle : anatomy.muscles) muscles.push_back(muscle.mechanics.key);
  return {read_named(folder / "bones", bones), read_named(folder / "muscles", muscles)};
}

}  // namespace myotact::prepare
