#include "layer/engine_surfaces.h"

#include <algorithm>

namespace myotact::layer {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

std::vector<const geometry::TriangleMesh*> all_surfaces(const anatomy::Specimen& specimen) {
  std::vector<const geometry::TriangleMesh*> surfaces;
  for (const anatomy::Muscle& muscle : specimen.muscles) surfaces.push_back(&muscle.skin);
  for (const anatomy::Bone& bone : specimen.bones) surfaces.push_back(&bone.surface);
  return surfaces;
}

}  // namespace

EngineSurfaces::EngineSurfaces(const anatomy::Specimen& specimen)
    : specimen_(specimen), patch_(all_surfaces(specimen)) {
  for (const geometry::TriangleMesh* surface : all_surfaces(specimen)) {
    frames_.push_back({surface->positions_m, surface->positions_m});
  }
  for (int s = 0; s < count(); ++s) {
    if (body_of(s) >= 0) {
      patch_.set_tissue(s,
                        std::vector<messages::TriangleTissue>(mesh(s).triangles.size(), {messages::Tissue::Bone, {}}));
    }
    patch_.update_surface(s, frames_[at(s)].previous_m, frames_[at(s)].current_m);
  }
}

int EngineSurfaces::body_of(int surface) const {
  return surface < muscle_count() ? -1 : specimen_.bones[at(surface - muscle_count())].body;
}

const geometry::TriangleMesh& EngineSurfaces::mesh(int surface) const {
  return surface < muscle_count() ? specimen_.muscles[at(surface)].skin
                                  : specimen_.bones[at(surface - muscle_count())].surface;
}

EngineSurfaces::Frame& EngineSurfaces::next_frame(int surface) {
  Frame& frame = frames_[at(surface)];
  frame.previous_m.swap(frame.current_m);
  return frame;
}

void EngineSurfaces::follow(int surface, const Pose& X_WL) {
  Frame& frame = next_frame(surface);
  std::transform(mesh(surface).positions_m.begin(), mesh(surface).positions_m.end(), frame.current_m.begin(),
                 [&](const Vec3& rest_m) { return X_WL * rest_m; });
  patch_.update_surface(surface, frame.previous_m, frame.current_m);
}

void EngineSurfaces::follow(int surface, std::span<const Vec3> positions_m) {
  Frame& frame = next_frame(surface);
  std::copy(positions_m.begin(), positions_m.end(), frame.current_m.begin());
  patch_.update_surface(surface, frame.previous_m, frame.current_m);
}

}  // namespace myotact::layer
