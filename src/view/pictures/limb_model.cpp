#include "view/pictures/limb_model.h"

#include <cstddef>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/triangle_mesh.h"
#include "view/look/part.h"
#include "view/look/posing.h"
#include "view/look/visibility.h"
#include "view/render/attachment_areas.h"
#include "view/render/seam_normals.h"
#include "view/render/skin_tissue.h"
#include "view/render/sky_exposure.h"
#include "view/render/tissue_colours.h"

namespace myotact::view {

namespace {

using geometry::GlbNode;
using geometry::GlbScene;

constexpr float kLeastOpacity = 0.02f;  // below this nothing is drawn
constexpr float kMoist = 0.45f, kDull = 0.7f;

std::array<float, 3> plain(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

/// All skins as they are in the frame, one after the other.
std::vector<glm::vec3> skins_now(const anatomy::Specimen& specimen, const messages::SceneFrame& frame) {
  std::vector<glm::vec3> positions_m;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    const auto& rest = specimen.muscles[m].skin.positions_m;
    const bool moved = m < frame.skins_world_m.size() && frame.skins_world_m[m].size() == rest.size();
    for (std::size_t i = 0; i < rest.size(); ++i) {
      positions_m.push_back(moved ? to_glm(frame.skins_world_m[m][i]) : to_glm(rest[i]));
    }
  }
  return positions_m;
}

std::vector<glm::vec3> normals_of_skins(const anatomy::Specimen& specimen, const std::vector<glm::vec3>& positions_m) {
  std::vector<const geometry::TriangleMesh*> skins;
  for (const anatomy::Muscle& muscle : specimen.muscles) skins.push_back(&muscle.skin);
  std::vector<glm::vec3> normals;
  SeamNormals(skins).compute(positions_m, normals);
  return normals;
}

/// Only a view that parts the layers asks which muscles are superficial.
std::vector<bool> superficial_for(const anatomy::Specimen& specimen, const ViewState& view) {
  return view.layers.superficial == view.layers.deep ? std::vector<bool>{} : shade_limb(specimen).superficial;
}

template <typename Named>
GlbNode named_node(const Named& part, const char* kind) {
  GlbNode node;
  node.name = part.name_en.empty() ? part.key : part.name_en;
  node.extras = {{"key", part.key}, {"kind", kind}, {"name_la", part.name_la}};
  return node;
}

/// Of tissue that looks like this; the same material where there is one already.
int material(GlbScene& scene, const std::string& name, const glm::vec3& colour, const std::pair<float, float>& finish) {
  const auto [opacity, roughness] = finish;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (scene.materials[i].name == name && scene.materials[i].colour[3] == opacity) return static_cast<int>(i);
  }
  scene.materials.push_back({name, {colour.r, colour.g, colour.b, opacity}, roughness});
  return static_cast<int>(scene.materials.size()) - 1;
}

/// Belly and tendon, parted where half is tendon.
void add_tissues(const anatomy::Specimen& specimen, std::size_t m, float opacity, GlbScene& scene, GlbNode& node) {
  const anatomy::Muscle& muscle = specimen.muscles[m];
  const SkinTissue tissue = skin_tissue(muscle, line_of(specimen, static_cast<int>(m)));
  node.surfaces.resize(2);
  node.surfaces[0].material = material(scene, node.name, belly_colour(static_cast<int>(m)), {opacity, kMoist});
  node.surfaces[1].material = material(scene, "Tendon", kTendonColour, {opacity, kMoist});
  for (const auto& triangle : muscle.skin.triangles) {
    float share = 0.0f;
    for (const int vertex : triangle) share += tissue.tendons[static_cast<std::size_t>(vertex)] / 3.0f;
    node.surfaces[share < 0.5f ? 0 : 1].triangles.push_back(triangle);
  }
}

GlbNode bone_node(const anatomy::Bone& bone, const glm::mat4& pose) {
  GlbNode node = named_node(bone, "bone");
  for (const Vec3& p : bone.surface.positions_m) {
    node.positions_m.push_back(plain(glm::vec3(pose * glm::vec4(to_glm(p), 1.0f))));
  }
  for (const Vec3& n : geometry::vertex_normals(bone.surface)) {
    node.normals.push_back(plain(glm::normalize(glm::mat3(pose) * to_glm(n))));
  }
  return node;
}

}  // namespace

GlbScene limb_model(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, const ViewState& view) {
  GlbScene scene;
  scene.name = specimen.name;
  scene.copyright = specimen.licence + ". " + specimen.source;
  scene.extras = {{"species", specimen.species}, {"breed", specimen.breed}, {"side", specimen.side}};
  scene.groups = {{"Bones", {}}, {"Muscles", {}}};
  const std::vector<bool> superficial = superficial_for(specimen, view);
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) {
    const float opacity = opacity_of(view, superficial, {PartKind::Bone, static_cast<int>(b)});
    if (opacity < kLeastOpacity) continue;
    GlbNode node = bone_node(specimen.bones[b], pose_of_bone(specimen, frame, b));
    node.surfaces = {{material(scene, "Bone", kBoneColour, {opacity, kDull}), specimen.bones[b].surface.triangles}};
    scene.groups[0].nodes.push_back(std::move(node));
  }
  const std::vector<glm::vec3> positions_m = skins_now(specimen, frame);
  const std::vector<glm::vec3> normals = normals_of_skins(specimen, positions_m);
  std::size_t first = 0;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    const std::size_t end = first + specimen.muscles[m].skin.positions_m.size();
    const std::size_t begin = std::exchange(first, end);
    const float opacity = opacity_of(view, superficial, {PartKind::Muscle, static_cast<int>(m)});
    if (opacity < kLeastOpacity) continue;
    GlbNode node = named_node(specimen.muscles[m], "muscle");
    for (std::size_t i = begin; i < end; ++i) {
      node.positions_m.push_back(plain(positions_m[i]));
      node.normals.push_back(plain(normals[i]));
    }
    add_tissues(specimen, m, opacity, scene, node);
    scene.groups[1].nodes.push_back(std::move(node));
  }
  return scene;
}

}  // namespace myotact::view
