#include "view/look/limb_bounds.h"

#include "view/look/posing.h"

namespace myotact::view {

namespace {

constexpr float kFar_m = 1e9f;

struct Growing {
  ViewBox box{glm::vec3(kFar_m), glm::vec3(-kFar_m)};

  void add(const glm::vec3& p) {
    box.lowest_m = glm::min(box.lowest_m, p);
    box.highest_m = glm::max(box.highest_m, p);
  }
  void add(const geometry::TriangleMesh& surface, const glm::mat4& world_from_model) {
    for (const Vec3& p : surface.positions_m) add(glm::vec3(world_from_model * glm::vec4(to_glm(p), 1.0f)));
  }
  void add_muscle(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, std::size_t m) {
    if (m >= frame.skins_world_m.size()) {
      add(specimen.muscles[m].skin, glm::mat4(1.0f));
      return;
    }
    for (const auto& p : frame.skins_world_m[m]) add(to_glm(p));
  }
};

}  // namespace

ViewBox bounds_of(const anatomy::Specimen& specimen) {
  return bounds_of(specimen, messages::SceneFrame{});
}

ViewBox bounds_of(const anatomy::Specimen& specimen, const messages::SceneFrame& frame) {
  Growing bounds;
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) {
    bounds.add(specimen.bones[b].surface, pose_of_bone(specimen, frame, b));
  }
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) bounds.add_muscle(specimen, frame, m);
  return bounds.box;
}

ViewBox bounds_of(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, const Part& part) {
  Growing bounds;
  const auto i = static_cast<std::size_t>(part.index);
  if (part.kind == PartKind::Bone) {
    bounds.add(specimen.bones[i].surface, pose_of_bone(specimen, frame, i));
  } else {
    bounds.add_muscle(specimen, frame, i);
  }
  return bounds.box;
}

}  // namespace myotact::view
