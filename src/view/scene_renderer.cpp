#include "view/scene_renderer.h"

#include <algorithm>
#include <cmath>

#include <epoxy/gl.h>

#include "view/colour_map.h"
#include "view/posing.h"
#include "view/tool_drawing.h"

namespace myotact::view {

namespace {

constexpr glm::vec4 kBone{0.91f, 0.87f, 0.77f, 1.0f};
constexpr glm::vec3 kBackground{0.955f, 0.96f, 0.965f};
constexpr glm::vec4 kLine{0.80f, 0.18f, 0.12f, 1.0f};
constexpr float kMuscleOpacity = 0.82f;  // bones shine through
constexpr float kLineRadius_m = 0.9e-3f;

/// Area-weighted normals from the positions as they are now.
void compute_normals(DrawMesh& mesh) {
  for (DrawVertex& vertex : mesh.vertices) vertex.normal = glm::vec3(0.0f);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    DrawVertex& a = mesh.vertices[mesh.indices[i]];
    DrawVertex& b = mesh.vertices[mesh.indices[i + 1]];
    DrawVertex& c = mesh.vertices[mesh.indices[i + 2]];
    const glm::vec3 area = glm::cross(b.position - a.position, c.position - a.position);
    a.normal += area;
    b.normal += area;
    c.normal += area;
  }
}

void set_triangles(DrawMesh& mesh, const geometry::TriangleMesh& surface) {
  mesh.indices.clear();
  for (const auto& triangle : surface.triangles) {
    for (const int vertex : triangle) mesh.indices.push_back(static_cast<std::uint32_t>(vertex));
  }
}

DrawMesh bone_mesh(const anatomy::Bone& bone) {
  DrawMesh mesh;
  for (const Vec3& position : bone.surface.positions_m) mesh.vertices.push_back({to_glm(position), {}, kBone});
  set_triangles(mesh, bone.surface);
  compute_normals(mesh);
  return mesh;
}

/// Squares of 50 mm on the ground, fading outwards.
DrawMesh grid_mesh(const ViewBox& bounds) {
  constexpr float kSquare_m = 0.05f;
  constexpr int kSquares = 6;
  DrawMesh mesh;
  const glm::vec3 centre(0.5f * (bounds.lowest_m.x + bounds.highest_m.x),
                         0.5f * (bounds.lowest_m.y + bounds.highest_m.y), bounds.lowest_m.z);
  const glm::vec4 colour(0.72f, 0.74f, 0.77f, 1.0f);
  for (int i = -kSquares; i <= kSquares; ++i) {
    const float at = kSquare_m * static_cast<float>(i);
    const float end = kSquare_m * kSquares;
    for (const auto& [from, to] : {std::pair{glm::vec3(at, -end, 0), glm::vec3(at, end, 0)},
                                   std::pair{glm::vec3(-end, at, 0), glm::vec3(end, at, 0)}}) {
      const auto start = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back({centre + from, {}, colour});
      mesh.vertices.push_back({centre + to, {}, colour});
      mesh.indices.insert(mesh.indices.end(), {start, start + 1});
    }
  }
  return mesh;
}

}  // namespace

SceneRenderer::SceneRenderer(const anatomy::Specimen& specimen)
    : specimen_(&specimen), surface_("surface"), flat_("flat"), muscles_(specimen.muscles.size()) {
  for (const auto& bone : specimen.bones) {
    bones_.emplace_back();
    bones_.back().upload(bone_mesh(bone));
  }
  const ViewBox bounds = bounds_of(specimen);
  middle_m_ = 0.5f * (bounds.lowest_m + bounds.highest_m);
  grid_.upload(grid_mesh(bounds));
}

void SceneRenderer::draw(const messages::SceneFrame& frame, const Camera& camera, const Viewport& viewport,
                         const std::vector<SceneMark>& marks) {
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  glScissor(viewport.x, viewport.y, viewport.width, viewport.height);
  glEnable(GL_SCISSOR_TEST);  // clearing keeps to the viewport
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glClearColor(kBackground.r, kBackground.g, kBackground.b, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  const glm::mat4 clip_from_world =
      camera.clip_from_world(static_cast<float>(viewport.width) / static_cast<float>(std::max(viewport.height, 1)));
  flat_.use();
  flat_.set("clip_from_world", clip_from_world);
  grid_.draw(GL_LINES);
  surface_.use();
  surface_.set("clip_from_world", clip_from_world);
  surface_.set("eye_world", camera.eye_world_m());
  draw_bones(frame);
  surface_.set("world_from_model", glm::mat4(1.0f));
  draw_lines_and_tools(frame);
  draw_muscles(frame);
  draw_marks(marks);
}

void SceneRenderer::draw_bones(const messages::SceneFrame& frame) {
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    const auto body = static_cast<std::size_t>(specimen_->bones[b].body);
    surface_.set("world_from_model", body < frame.body_poses.size() ? to_glm(frame.body_poses[body]) : glm::mat4(1.0f));
    bones_[b].draw(GL_TRIANGLES);
  }
}

void SceneRenderer::draw_muscles(const messages::SceneFrame& frame) {
  for (std::size_t m = 0; m < muscles_.size() && m < frame.skins_world_m.size(); ++m) {
    const glm::vec4 colour(cividis(frame.activations[m]), kMuscleOpacity);
    scratch_.vertices.clear();
    for (const auto& p : frame.skins_world_m[m]) scratch_.vertices.push_back({{p[0], p[1], p[2]}, {}, colour});
    set_triangles(scratch_, specimen_->muscles[m].skin);
    compute_normals(scratch_);
    muscles_[m].upload(scratch_);
  }
  // Each muscle hides its own back, but shows what lies behind it: bones, lines, deeper muscles drawn before.
  glEnable(GL_CULL_FACE);
  for (const Drawable& muscle : muscles_) muscle.draw(GL_TRIANGLES);
  glDisable(GL_CULL_FACE);
}

void SceneRenderer::draw_lines_and_tools(const messages::SceneFrame& frame) {
  scratch_.vertices.clear();
  scratch_.indices.clear();
  for (const auto& line : frame.lines_world_m) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      add_tube(scratch_, to_glm(line[i]), to_glm(line[i + 1]), kLineRadius_m, kLine);
    }
  }
  for (const messages::ToolFrame& tool : frame.tools) {
    add_tool(scratch_, tool, middle_m_);
  }
  overlay_.upload(scratch_);
  overlay_.draw(GL_TRIANGLES);
}

void SceneRenderer::draw_marks(const std::vector<SceneMark>& marks) {
  if (marks.empty()) return;
  scratch_.vertices.clear();
  scratch_.indices.clear();
  for (const SceneMark& mark : marks) add_sphere(scratch_, mark.place_world_m, mark.radius_m, mark.colour);
  overlay_.upload(scratch_);
  glDisable(GL_DEPTH_TEST);
  overlay_.draw(GL_TRIANGLES);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace myotact::view
