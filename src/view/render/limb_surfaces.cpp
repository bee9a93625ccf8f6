#include "view/render/limb_surfaces.h"

#include <algorithm>

#include "core/at.h"
#include "view/look/posing.h"
#include "view/render/attachment_areas.h"

namespace myotact::view {

namespace {

constexpr float kStrokeLift_m = 0.25e-3f;  // above the skin, or it would sink in where the skin bends

SurfaceSet::Run append_triangles(const geometry::TriangleMesh& surface, std::size_t first_vertex,
                                 std::vector<std::uint32_t>& indices) {
  const SurfaceSet::Run run{static_cast<int>(indices.size()), static_cast<int>(3 * surface.triangles.size())};
  for (const auto& triangle : surface.triangles) {
    for (const int vertex : triangle) indices.push_back(static_cast<std::uint32_t>(first_vertex + at(vertex)));
  }
  return run;
}

/// From origin to insertion, or the longest way when there is no line.
glm::vec3 axis_of(const anatomy::Specimen& specimen, std::size_t m) {
  const anatomy::MuscleLine* line = line_of(specimen, static_cast<int>(m));
  if (line == nullptr || line->points.size() < 2) return {0.0f, 0.0f, 1.0f};
  const glm::vec3 way = to_glm(line->points.back().position_m) - to_glm(line->points.front().position_m);
  return glm::length(way) > 0.0f ? glm::normalize(way) : glm::vec3(0.0f, 0.0f, 1.0f);
}

/// Area-weighted normals from the positions as they are now.
void compute_normals(const geometry::TriangleMesh& surface, std::span<MovingVertex> vertices) {
  for (MovingVertex& vertex : vertices) vertex.normal = glm::vec3(0.0f);
  for (const auto& [i, j, k] : surface.triangles) {
    MovingVertex &a = vertices[at(i)], &b = vertices[at(j)], &c = vertices[at(k)];
    const glm::vec3 area = glm::cross(b.position - a.position, c.position - a.position);
    a.normal += area;
    b.normal += area;
    c.normal += area;
  }
}

glm::vec3 middle_of(std::span<const MovingVertex> vertices) {
  glm::vec3 sum(0.0f);
  for (const MovingVertex& vertex : vertices) sum += vertex.position;
  return vertices.empty() ? sum : sum / static_cast<float>(vertices.size());
}

}  // namespace

LimbSurfaces::LimbSurfaces(const anatomy::Specimen& specimen) : specimen_(&specimen) {
  LimbShade shade = shade_limb(specimen);
  superficial_ = std::move(shade.superficial);
  prepare_bones(shade);
  std::vector<FixedVertex> fixed;
  std::vector<std::uint32_t> indices;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) add_muscle(m, shade.muscles[m], fixed, indices);
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) add_attachments(m, fixed, indices);
  skins_.prepare(fixed, indices);
  moving_.resize(fixed.size());
  muscle_middles_world_m_.resize(specimen.muscles.size());
}

void LimbSurfaces::add_muscle(std::size_t m, const LimbShade::Vertices& shade, std::vector<FixedVertex>& fixed,
                              std::vector<std::uint32_t>& indices) {
  const anatomy::Muscle& muscle = specimen_->muscles[m];
  first_vertex_.push_back(fixed.size());
  muscle_runs_.push_back(append_triangles(muscle.skin, fixed.size(), indices));
  const glm::vec3 axis = axis_of(*specimen_, m);
  const auto areas = attachment_areas(muscle, line_of(*specimen_, static_cast<int>(m)));
  for (std::size_t i = 0; i < muscle.skin.positions_m.size(); ++i) {
    fixed.push_back({shade.alone[i], shade.together[i], glm::dot(axis, to_glm(muscle.skin.positions_m[i])),
                     areas[i] == AttachmentEnd::Origin ? 1.0f : 0.0f,
                     areas[i] == AttachmentEnd::Insertion ? 1.0f : 0.0f});
  }
}

void LimbSurfaces::add_attachments(std::size_t m, const std::vector<FixedVertex>& fixed,
                                   std::vector<std::uint32_t>& indices) {
  SurfaceSet::Run run{static_cast<int>(indices.size()), 0};
  for (const auto& triangle : specimen_->muscles[m].skin.triangles) {
    const auto attached = [&](int i) {
      const FixedVertex& vertex = fixed[first_vertex_[m] + at(i)];
      return vertex.origin + vertex.insertion > 0.0f;
    };
    if (!std::all_of(triangle.begin(), triangle.end(), attached)) continue;
    for (const int i : triangle) indices.push_back(static_cast<std::uint32_t>(first_vertex_[m] + at(i)));
    run.count += 3;
  }
  attachment_runs_.push_back(run);
}

void LimbSurfaces::prepare_bones(const LimbShade& shade) {
  std::vector<FixedVertex> fixed;
  std::vector<MovingVertex> placed;
  std::vector<std::uint32_t> indices;
  for (std::size_t b = 0; b < specimen_->bones.size(); ++b) {
    const geometry::TriangleMesh& surface = specimen_->bones[b].surface;
    const std::size_t first = placed.size();
    bone_runs_.push_back(append_triangles(surface, first, indices));
    for (std::size_t i = 0; i < surface.positions_m.size(); ++i) {
      placed.push_back({to_glm(surface.positions_m[i]), {}, 0.0f});
      fixed.push_back({shade.bones[b].alone[i], shade.bones[b].together[i], 0.0f, 0.0f, 0.0f});
    }
    const std::span<MovingVertex> bone = std::span(placed).subspan(first);
    compute_normals(surface, bone);
    bone_middles_m_.push_back(middle_of(bone));
  }
  bones_.prepare(fixed, indices);
  bones_.move(placed);
  poses_.assign(bone_middles_m_.size(), glm::mat4(1.0f));
  bone_middles_world_m_ = bone_middles_m_;
}

std::span<MovingVertex> LimbSurfaces::skin(std::size_t m) {
  return std::span(moving_).subspan(first_vertex_[m], specimen_->muscles[m].skin.positions_m.size());
}

std::size_t LimbSurfaces::move(const messages::SceneFrame& frame, std::span<const std::vector<float>> levels) {
  for (std::size_t b = 0; b < poses_.size(); ++b) {
    poses_[b] = pose_of_bone(*specimen_, frame, b);
    bone_middles_world_m_[b] = glm::vec3(poses_[b] * glm::vec4(bone_middles_m_[b], 1.0f));
  }
  for (std::size_t m = 0; m < specimen_->muscles.size(); ++m) {
    const std::span<MovingVertex> vertices = skin(m);
    const bool there = m < frame.skins_world_m.size() && frame.skins_world_m[m].size() == vertices.size();
    const bool valued = m < levels.size() && levels[m].size() == vertices.size();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      vertices[i].position =
          there ? to_glm(frame.skins_world_m[m][i]) : to_glm(specimen_->muscles[m].skin.positions_m[i]);
      vertices[i].value = valued ? levels[m][i] : 0.0f;
    }
    compute_normals(specimen_->muscles[m].skin, vertices);
    muscle_middles_world_m_[m] = middle_of(vertices);
  }
  return skins_.move(moving_);
}

void LimbSurfaces::draw(const Part& part) const {
  const bool bone = part.kind == PartKind::Bone;
  (bone ? bones_ : skins_).draw((bone ? bone_runs_ : muscle_runs_)[at(part.index)]);
}

int LimbSurfaces::draw_attachments(const std::vector<bool>& muscles) const {
  int calls = 0;
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    if (!muscles[m]) continue;
    // The runs follow one another: neighbours are drawn as one.
    SurfaceSet::Run run = attachment_runs_[m];
    for (; m + 1 < muscles.size() && muscles[m + 1]; ++m) run.count += attachment_runs_[m + 1].count;
    skins_.draw(run);
    ++calls;
  }
  return calls;
}

const glm::mat4& LimbSurfaces::pose_of(const Part& part) const {
  static const glm::mat4 kWorld(1.0f);  // skins are given in the world
  return part.kind == PartKind::Bone ? poses_[at(part.index)] : kWorld;
}

const glm::vec3& LimbSurfaces::middle_world_m(const Part& part) const {
  return (part.kind == PartKind::Bone ? bone_middles_world_m_ : muscle_middles_world_m_)[at(part.index)];
}

LimbSurfaces::StrokeNow LimbSurfaces::stroke_now(int muscle, const FibreStroke& stroke) const {
  const auto& triangle = specimen_->muscles[at(muscle)].skin.triangles[at(stroke.triangle)];
  const MovingVertex* first = &moving_[first_vertex_[at(muscle)]];
  const MovingVertex &a = first[triangle[0]], &b = first[triangle[1]], &c = first[triangle[2]];
  const glm::vec3 across = glm::cross(b.position - a.position, c.position - a.position);
  const float length = glm::length(across);
  const glm::vec3 normal = length > 0.0f ? across / length : glm::vec3(0.0f, 0.0f, 1.0f);
  const auto place = [&](const glm::vec3& shares) {
    return shares.x * a.position + shares.y * b.position + shares.z * c.position + kStrokeLift_m * normal;
  };
  return {place(stroke.shares[0]), place(stroke.shares[1]), normal};
}

}  // namespace myotact::view
