#include "view/render/limb_surfaces.h"

#include <algorithm>
#include <future>

#include "core/at.h"
#include "view/look/posing.h"
#include "view/render/attachment_areas.h"
#include "view/render/skin_tissue.h"
#include "view/render/strand_coordinates.h"

namespace myotact::view {

namespace {

constexpr float kStrokeLift_m = 0.25e-3f;  // above the skin, or it would sink in where the skin bends
/// Where muscles meet, fascia dips in between them: finer than a surface of a volume is, and what tells them apart.
constexpr float kSeamExposure = 0.4f;
constexpr std::size_t kThreads = 4;  // that prepare muscles, each on its own

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

glm::vec3 middle_of(std::span<const glm::vec3> positions_m) {
  glm::vec3 sum(0.0f);
  for (const glm::vec3& p : positions_m) sum += p;
  return positions_m.empty() ? sum : sum / static_cast<float>(positions_m.size());
}

SeamNormals seams_of(const anatomy::Specimen& specimen) {
  std::vector<const geometry::TriangleMesh*> skins;
  for (const auto& muscle : specimen.muscles) skins.push_back(&muscle.skin);
  return SeamNormals(skins);
}

}  // namespace

LimbSurfaces::LimbSurfaces(const anatomy::Specimen& specimen) : specimen_(&specimen) {
  LimbShade shade = shade_limb(specimen);
  superficial_ = std::move(shade.superficial);
  prepare_bones(shade);
  seams_ = seams_of(specimen);
  std::vector<FixedVertex> fixed;
  std::vector<std::uint32_t> indices;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) add_muscle(m, shade.muscles[m], fixed, indices);
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) add_attachments(m, fixed, indices);
  along_.resize(fixed.size());
  std::vector<std::future<void>> shares;
  for (std::size_t first = 0; first < kThreads; ++first) {
    shares.push_back(std::async(std::launch::async, [this, first, &fixed] {
      for (std::size_t m = first; m < specimen_->muscles.size(); m += kThreads) add_tissue(m, fixed);
    }));
  }
  for (auto& share : shares) share.get();
  skins_.prepare(fixed, indices);
  positions_m_.resize(fixed.size());
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
    FixedVertex vertex;
    vertex.alone = shade.alone[i];
    vertex.together = shade.together[i] * (seams_.at_seam()[fixed.size()] ? kSeamExposure : 1.0f);
    vertex.along_m = glm::dot(axis, to_glm(muscle.skin.positions_m[i]));
    vertex.origin = areas[i] == AttachmentEnd::Origin ? 1.0f : 0.0f;
    vertex.insertion = areas[i] == AttachmentEnd::Insertion ? 1.0f : 0.0f;
    fixed.push_back(vertex);
  }
}

/// What the muscle's look is made from. Its own vertices only: muscles are prepared side by side.
void LimbSurfaces::add_tissue(std::size_t m, std::vector<FixedVertex>& fixed) {
  const anatomy::Muscle& muscle = specimen_->muscles[m];
  const SkinTissue tissue = skin_tissue(muscle, line_of(*specimen_, static_cast<int>(m)));
  const auto strands_m = strand_coordinates(muscle.skin, tissue.fibres);
  const auto neighbours = neighbours_along(muscle.skin, tissue.fibres);
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    FixedVertex& vertex = fixed[first_vertex_[m] + i];
    vertex.tendon = tissue.tendons[i];
    vertex.strand_m = strands_m[i];
    for (std::size_t k = 0; k < 2; ++k) {
      along_[first_vertex_[m] + i][k] = static_cast<std::uint32_t>(first_vertex_[m] + at(neighbours[i][k]));
    }
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
    bone_runs_.push_back(append_triangles(surface, placed.size(), indices));
    const std::vector<Vec3> normals = geometry::vertex_normals(surface);
    std::vector<glm::vec3> positions_m;
    for (std::size_t i = 0; i < surface.positions_m.size(); ++i) {
      positions_m.push_back(to_glm(surface.positions_m[i]));
      placed.push_back({positions_m.back(), packed(to_glm(normals[i]), 0.0f), {}});
      FixedVertex vertex;
      vertex.alone = shade.bones[b].alone[i];
      vertex.together = shade.bones[b].together[i];
      vertex.strand_m = positions_m.back();
      fixed.push_back(vertex);
    }
    bone_middles_m_.push_back(middle_of(positions_m));
  }
  bones_.prepare(fixed, indices);
  bones_.move(placed);
  poses_.assign(bone_middles_m_.size(), glm::mat4(1.0f));
  bone_middles_world_m_ = bone_middles_m_;
}

std::size_t LimbSurfaces::move(const messages::SceneFrame& frame, std::span<const std::vector<float>> levels) {
  for (std::size_t b = 0; b < poses_.size(); ++b) {
    poses_[b] = pose_of_bone(*specimen_, frame, b);
    bone_middles_world_m_[b] = glm::vec3(poses_[b] * glm::vec4(bone_middles_m_[b], 1.0f));
  }
  for (std::size_t m = 0; m < specimen_->muscles.size(); ++m) {
    const std::vector<Vec3>& at_rest = specimen_->muscles[m].skin.positions_m;
    const std::span<glm::vec3> positions_m = std::span(positions_m_).subspan(first_vertex_[m], at_rest.size());
    const bool there = m < frame.skins_world_m.size() && frame.skins_world_m[m].size() == positions_m.size();
    for (std::size_t i = 0; i < positions_m.size(); ++i) {
      positions_m[i] = there ? to_glm(frame.skins_world_m[m][i]) : to_glm(at_rest[i]);
    }
    muscle_middles_world_m_[m] = middle_of(positions_m);
  }
  seams_.compute(positions_m_, normals_);
  for (std::size_t m = 0; m < specimen_->muscles.size(); ++m) {
    const std::size_t first = first_vertex_[m], count = specimen_->muscles[m].skin.positions_m.size();
    const bool valued = m < levels.size() && levels[m].size() == count;
    for (std::size_t i = 0; i < count; ++i) pack(first + i, valued ? levels[m][i] : 0.0f);
  }
  return skins_.move(moving_);
}

void LimbSurfaces::pack(std::size_t vertex, float level) {
  const glm::vec3 along = positions_m_[along_[vertex][0]] - positions_m_[along_[vertex][1]];
  const float length_m = glm::length(along);
  moving_[vertex] = {positions_m_[vertex], packed(normals_[vertex], level),
                     packed(length_m > 0.0f ? along / length_m : along)};
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
  const glm::vec3* first = &positions_m_[first_vertex_[at(muscle)]];
  const glm::vec3 &a = first[triangle[0]], &b = first[triangle[1]], &c = first[triangle[2]];
  const glm::vec3 across = glm::cross(b - a, c - a);
  const float length = glm::length(across);
  const glm::vec3 normal = length > 0.0f ? across / length : glm::vec3(0.0f, 0.0f, 1.0f);
  const auto place = [&](const glm::vec3& shares) {
    return shares.x * a + shares.y * b + shares.z * c + kStrokeLift_m * normal;
  };
  return {place(stroke.shares[0]), place(stroke.shares[1]), normal};
}

}  // namespace myotact::view
