#include "simulation/touch/surfaces.h"

#include "anatomy/touch_surfaces.h"
#include "core/at.h"
#include "simulation/muscle/touch_surface.h"
#include "simulation/skin/skin_tissue.h"

namespace myotact::simulation {

Surfaces::Surfaces(const anatomy::Specimen& specimen, const Limb& limb) : specimen_(specimen) {
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    skins_.push_back(embed_skin(specimen.muscles[m].skin, limb.muscles[m].tissue.mesh));
  }
  const std::vector<const geometry::TriangleMesh*> surfaces = anatomy::touch_surfaces(specimen);
  for (const geometry::TriangleMesh* surface : surfaces)
    frames_.push_back({surface->positions_m, surface->positions_m});
  patch_ = std::make_unique<LocalPatch>(surfaces);
  for (int s = 0; s < count(); ++s) patch_->set_tissue(s, tissue_of(s));
}

std::vector<messages::TriangleTissue> Surfaces::tissue_of(int surface) const {
  const std::size_t muscles = specimen_.muscles.size();
  if (at(surface) < muscles) return skin_tissue(specimen_.muscles[at(surface)], skins_[at(surface)]);
  const std::size_t triangles = specimen_.bones[at(surface) - muscles].surface.triangles.size();
  return std::vector<messages::TriangleTissue>(triangles, {messages::Tissue::Bone, {}});
}

void Surfaces::update(const Limb& limb, int surface) {
  Frame& frame = frames_[at(surface)];
  const int muscles = static_cast<int>(specimen_.muscles.size());
  if (surface < muscles) {
    update_skin(skins_[at(surface)], as_points(limb.muscles[at(surface)].state.now.position_m), frame.current_m);
    return;
  }
  const anatomy::Bone& bone = specimen_.bones[at(surface - muscles)];
  const Pose& pose = limb.skeleton.body_pose(bone.body);
  for (std::size_t v = 0; v < frame.current_m.size(); ++v) frame.current_m[v] = pose * bone.surface.positions_m[v];
}

void Surfaces::follow(const Limb& limb, int surface, bool restart) {
  Frame& frame = frames_[at(surface)];
  frame.previous_m.swap(frame.current_m);
  update(limb, surface);
  if (restart) frame.previous_m = frame.current_m;
  patch_->update_surface(surface, frame.previous_m, frame.current_m);
}

}  // namespace myotact::simulation
