#include "prepare/recipe/make_limb.h"

#include <algorithm>

#include "core/error.h"
#include "prepare/recipe/build_band.h"

namespace myotact::prepare {

namespace {

const NamedSurface* find_surface(const std::vector<NamedSurface>& surfaces, const std::string& key) {
  const auto found =
      std::find_if(surfaces.begin(), surfaces.end(), [&](const NamedSurface& surface) { return surface.key == key; });
  return found == surfaces.end() ? nullptr : &*found;
}

}  // namespace

LimbWork make_limb(const AnatomyData& recipe, const std::vector<NamedSurface>& bones,
                   const std::vector<NamedSurface>& muscles, const PrepareSettings& settings) {
  LimbWork limb;
  limb.anatomy = recipe;
  limb.settings = settings;
  for (const BoneData& data : recipe.bones) {
    if (const auto* surface = find_surface(bones, data.key)) limb.bones.push_back({data, surface->surface, {}, {}});
  }
  if (limb.bones.empty() && !recipe.bones.empty()) {
    throw Error(ExitStatus::BadData, "bones: none of the input's is named in the recipe; rename the surfaces");
  }
  for (const MuscleData& data : recipe.muscles) {
    const auto* surface = find_surface(muscles, data.mechanics.key);
    if (!surface) continue;
    MuscleWork& muscle = limb.muscles.emplace_back();
    muscle.data = data;
    muscle.surface = surface->surface;
    muscle.middle_m = surface->middle_m;
  }
  if (limb.muscles.empty() && !recipe.muscles.empty()) {
    throw Error(ExitStatus::BadData, "muscles: none of the input's is named in the recipe; rename the surfaces");
  }
  for (const BandData& band : recipe.built) {
    BoneWork& bone = limb.bones.emplace_back();
    bone.data = band.bone;
    bone.surface = build_band(band);
    bone.report.notes.push_back("built: not part of the input");
  }
  return limb;
}

}  // namespace myotact::prepare
