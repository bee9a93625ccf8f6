#include "simulation/touch/surfaces.h"

#include <algorithm>

#include "anatomy/touch_surfaces.h"
#include "core/at.h"
#include "simulation/muscle/touch_surface.h"
#include "simulation/skin/skin_tissue.h"
#include "simulation/skin/smooth_embedding.h"

namespace myotact::simulation {
namespace {

/// A surface stays where it was drawn until one of its nodes has moved this far along an axis: at 8000 N/m, the
/// stiffest of the devices in assets/devices, that is felt as 7 mN at most.
constexpr double kUnfelt_m = 0.5e-6;

}  // namespace

Surfaces::Surfaces(const anatomy::Specimen& specimen, const Limb& limb) : specimen_(specimen) {
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    const geometry::TriangleMesh& skin = specimen.muscles[m].skin;
    const geometry::TetMesh& tets = limb.muscles[m].tissue.mesh;
    skins_.push_back(embed_skin(skin, tets));
    if (!limb.muscles[m].rigid) smooth_embedding(skin, tets, skins_.back());  // others are fitted to bones as they are
  }
  const std::vector<const geometry::TriangleMesh*> surfaces = anatomy::touch_surfaces(specimen);
  for (const geometry::TriangleMesh* surface : surfaces) {
    Frame& frame = frames_.emplace_back();
    frame.previous_m = frame.current_m = surface->positions_m;
  }
  patch_ = std::make_unique<LocalPatch>(surfaces);
  for (int s = 0; s < count(); ++s) patch_->set_tissue(s, tissue_of(s));
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) {
    Frame& frame = frames_[specimen.muscles.size() + b];
    for (const Vec3& p : specimen.bones[b].surface.positions_m) frame.radius_m = std::max(frame.radius_m, p.norm());
  }
}

std::vector<messages::TriangleTissue> Surfaces::tissue_of(int surface) const {
  const std::size_t muscles = specimen_.muscles.size();
  if (at(surface) < muscles) return skin_tissue(specimen_.muscles[at(surface)], skins_[at(surface)]);
  const std::size_t triangles = specimen_.bones[at(surface) - muscles].surface.triangles.size();
  return std::vector<messages::TriangleTissue>(triangles, {messages::Tissue::Bone, {}});
}

bool Surfaces::is_still(const Limb& limb, int surface) const {
  const Frame& frame = frames_[at(surface)];
  const int muscles = static_cast<int>(specimen_.muscles.size());
  if (surface < muscles) {
    const Eigen::VectorXd& now_m = limb.muscles[at(surface)].state.now.position_m;
    return frame.nodes_m.size() == now_m.size() && (now_m - frame.nodes_m).cwiseAbs().maxCoeff() < kUnfelt_m;
  }
  const Pose& pose = limb.skeleton.body_pose(specimen_.bones[at(surface - muscles)].body);
  return (pose.translation_m - frame.pose.translation_m).norm() +
             (pose.rotation - frame.pose.rotation).norm() * frame.radius_m <
         kUnfelt_m;
}

void Surfaces::update(const Limb& limb, int surface) {
  Frame& frame = frames_[at(surface)];
  const int muscles = static_cast<int>(specimen_.muscles.size());
  if (surface < muscles) {
    frame.nodes_m = limb.muscles[at(surface)].state.now.position_m;
    update_skin(skins_[at(surface)], as_points(frame.nodes_m), frame.current_m);
    return;
  }
  const anatomy::Bone& bone = specimen_.bones[at(surface - muscles)];
  const Pose& pose = frame.pose = limb.skeleton.body_pose(bone.body);
  for (std::size_t v = 0; v < frame.current_m.size(); ++v) frame.current_m[v] = pose * bone.surface.positions_m[v];
}

void Surfaces::follow(const Limb& limb, int surface, bool restart) {
  Frame& frame = frames_[at(surface)];
  const bool still = !restart && is_still(limb, surface);
  if (still && frame.at_rest) return;
  if (!still) {
    frame.previous_m.swap(frame.current_m);
    update(limb, surface);
  }
  frame.at_rest = still || restart;
  if (frame.at_rest) frame.previous_m = frame.current_m;
  patch_->update_surface(surface, frame.previous_m, frame.current_m);
}

}  // namespace myotact::simulation
