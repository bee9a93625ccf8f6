#include "view/render/scene_renderer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <epoxy/gl.h>

#include "view/charts/colour_map.h"
#include "view/look/posing.h"
#include "view/look/visibility.h"
#include "view/render/ground_shadow.h"
#include "view/render/spring_drawing.h"
#include "view/render/tissue_colours.h"
#include "view/render/tool_drawing.h"

namespace myotact::view {

namespace {

constexpr glm::vec4 kLine{0.13f, 0.13f, 0.22f, 1.0f};  // darker than flesh, tendon and all that is laid over them
constexpr glm::vec4 kFibre{0.98f, 0.92f, 0.84f, 0.60f};
constexpr glm::vec4 kSelected{0.76f, 0.18f, 0.52f, 1.0f}, kHovered{0.36f, 0.36f, 0.42f, 0.9f};
constexpr float kLineRadius_m = 0.8e-3f;
constexpr float kSeenThroughLine = 0.30f;  // opacity of what of a line or tool lies inside the limb
constexpr float kOpaque = 0.995f;          // above this nothing shines through
constexpr float kLeast = 0.02f;            // below this nothing is drawn
constexpr float kGlassOpacity = 0.30f;     // of a muscle whose attachments are shown
constexpr float kMuscleGloss = 0.20f, kBoneGloss = 0.06f;
constexpr float kMapShare = 0.9f;  // of a map on the skin
constexpr float kGlowRadius_m = 0.016f, kFullGlow_N = 2.0f;

/// Squares of 50 mm on the ground.
DrawMesh grid_mesh(const ViewBox& bounds) {
  constexpr float kSquare_m = 0.05f;
  constexpr int kSquares = 6;
  DrawMesh mesh;
  const glm::vec3 centre(0.5f * (bounds.lowest_m.x + bounds.highest_m.x),
                         0.5f * (bounds.lowest_m.y + bounds.highest_m.y), bounds.lowest_m.z);
  const glm::vec4 colour(0.60f, 0.62f, 0.66f, 0.55f);
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

/// Over the viewer's left shoulder, from above: what stands out is lit from the upper left, as in atlases.
glm::vec3 key_light_of(const Camera& camera) {
  return glm::normalize(-0.75f * camera.forward_world() - 0.45f * camera.right_world() + 0.65f * camera.up_world());
}

/// Where tools press, the skin glows: place and radius, colour and strength.
struct Glow {
  glm::vec4 place{0.0f, 0.0f, 0.0f, 1.0f}, colour{0.0f};
};
std::array<Glow, 2> glows_of(const messages::SceneFrame& frame) {
  std::array<Glow, 2> glows;
  for (std::size_t t = 0; t < std::min(glows.size(), frame.tools.size()); ++t) {
    const messages::ToolFrame& tool = frame.tools[t];
    if (!tool.in_contact) continue;
    const float strength = std::min(glm::length(to_glm(tool.force_world_N)) / kFullGlow_N, 1.0f);
    const auto reach_m = kGlowRadius_m + 2.0f * static_cast<float>(tool.radius_m);
    glows[t] = {glm::vec4(to_glm(tool.proxy_world_m), reach_m), glm::vec4(1.0f, 0.80f, 0.25f, 0.85f * strength)};
  }
  return glows;
}

}  // namespace

struct SceneRenderer::Picture {
  const messages::SceneFrame& frame;
  const ViewState& view;
  const Viewport& viewport;
  const SceneExtras& extras;
  glm::mat4 clip_from_world;
  glm::vec4 kept;                     // of the section
  std::vector<MuscleTint> tints;      // of the muscles
  std::vector<float> muscles, bones;  // opacities

  float opacity(const Part& part) const {
    return (part.kind == PartKind::Bone ? bones : muscles)[static_cast<std::size_t>(part.index)];
  }
  bool shows_attachments(int muscle) const {
    return view.attachments && (view.selected_muscle < 0 || view.selected_muscle == muscle);
  }
};

SceneRenderer::SceneRenderer(const anatomy::Specimen& specimen)
    : specimen_(&specimen),
      box_(bounds_of(specimen)),
      limb_program_("limb"),
      outline_program_("outline"),
      surface_program_("surface"),
      flat_program_("flat"),
      limb_(specimen) {
  for (const auto& muscle : specimen.muscles) strokes_.push_back(fibre_strokes(muscle));
  grid_.upload(grid_mesh(box_));
}

void SceneRenderer::draw(const messages::SceneFrame& frame, const ViewState& view, const Viewport& viewport,
                         const SceneExtras& extras) {
  const auto since = std::chrono::steady_clock::now();
  statistics_ = {};
  const float aspect = static_cast<float>(viewport.width) / static_cast<float>(std::max(viewport.height, 1));
  Picture picture{frame,
                  view,
                  viewport,
                  extras,
                  view.camera.clip_from_world(aspect),
                  kept_half_space(view.section, box_),
                  tint_muscles(*specimen_, frame, view.colour, extras.joint),
                  {},
                  {}};
  for (int m = 0; m < static_cast<int>(specimen_->muscles.size()); ++m) {
    const float opacity = opacity_of(view, superficial(), {PartKind::Muscle, m});
    picture.muscles.push_back(picture.shows_attachments(m) ? kGlassOpacity * opacity : opacity);
  }
  for (int b = 0; b < static_cast<int>(specimen_->bones.size()); ++b) {
    picture.bones.push_back(opacity_of(view, superficial(), {PartKind::Bone, b}));
  }
  if (extras.stroke_scale != 1.0f) glLineWidth(extras.stroke_scale);  // at most what the graphics card can
  begin(picture);
  move_limb(picture);
  draw_limb(picture);
  if (extras.hovered && extras.hovered != selected_part(view)) draw_outline(picture, extras.hovered, kHovered, 2.0f);
  if (const Part part = selected_part(view)) draw_outline(picture, part, kSelected, 3.0f);
  draw_marks(picture);
  if (extras.stroke_scale != 1.0f) glLineWidth(1.0f);
  glDisable(GL_SCISSOR_TEST);
  statistics_.frame_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since).count();
}

void SceneRenderer::begin(const Picture& picture) {
  const Viewport& viewport = picture.viewport;
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  glScissor(viewport.x, viewport.y, viewport.width, viewport.height);
  glEnable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  const glm::vec3& background = picture.extras.background;
  glClearColor(background.r, background.g, background.b, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  flat_program_.use();
  flat_program_.set("clip_from_world", picture.clip_from_world);
  glDepthMask(GL_FALSE);
  scratch_ = {};
  add_ground_shadow(scratch_, *specimen_, picture.frame, box_.lowest_m.z);
  upload_and_draw(shadow_, GL_TRIANGLES);
  glDepthMask(GL_TRUE);
  draw_again(grid_, GL_LINES);
}

/// Sends what moved and what is the same for all parts.
void SceneRenderer::move_limb(const Picture& picture) {
  levels_.clear();
  const bool mapped = picture.view.colour == MuscleColour::Pressure && !picture.extras.pressures_Pa.empty();
  if (mapped) {
    levels_.assign(picture.extras.pressures_Pa.begin(), picture.extras.pressures_Pa.end());
    for (auto& muscle : levels_) {
      for (float& level : muscle) level /= kPressureRange_Pa;
    }
  }
  statistics_.uploaded_bytes += limb_.move(picture.frame, levels_);
  const ViewState& view = picture.view;
  const auto present = std::count_if(picture.muscles.begin(), picture.muscles.end(),
                                     [](float opacity) { return opacity >= kSolidOpacity; });
  limb_program_.use();
  limb_program_.set("clip_from_world", picture.clip_from_world);
  limb_program_.set("eye_world", view.camera.eye_world_m());
  limb_program_.set("key_world", key_light_of(view.camera));
  limb_program_.set("kept", picture.kept);
  // What is not there casts no shade: of the muscles together, as far as they are together.
  limb_program_.set("together", picture.muscles.empty()
                                    ? 1.0f
                                    : static_cast<float>(present) / static_cast<float>(picture.muscles.size()));
  limb_program_.set("ends[0]", kOriginColour);
  limb_program_.set("ends[1]", kInsertionColour);
  limb_program_.set("show_ends", 0.0f);
  const auto glows = glows_of(picture.frame);
  for (std::size_t i = 0; i < glows.size(); ++i) {
    limb_program_.set(i == 0 ? "glow_place[0]" : "glow_place[1]", glows[i].place);
    limb_program_.set(i == 0 ? "glow_colour[0]" : "glow_colour[1]", glows[i].colour);
  }
  limb_program_.set("map_colours", red_yellow_table());
  limb_program_.set("mapped_share", 0.0f);
}

/// What is opaque first, from the near side, so that little is painted twice; then lines and tools; then what shines
/// through, from the far side.
void SceneRenderer::draw_limb(const Picture& picture) {
  std::vector<Part> opaque, clear;
  const auto sort_out = [&](const Part& part) {
    const float opacity = picture.opacity(part);
    if (opacity > kLeast) (opacity < kOpaque ? clear : opaque).push_back(part);
  };
  for (int m = 0; m < static_cast<int>(picture.muscles.size()); ++m) sort_out({PartKind::Muscle, m});
  for (int b = 0; b < static_cast<int>(picture.bones.size()); ++b) sort_out({PartKind::Bone, b});
  const glm::vec3 eye_m = picture.view.camera.eye_world_m();
  const auto nearer = [&](const Part& a, const Part& b) {
    return glm::distance(limb_.middle_world_m(a), eye_m) < glm::distance(limb_.middle_world_m(b), eye_m);
  };
  std::stable_sort(opaque.begin(), opaque.end(), nearer);
  std::stable_sort(clear.begin(), clear.end(), nearer);
  const bool cut = picture.view.section.on;
  if (cut) glEnable(GL_CLIP_DISTANCE0);
  if (!cut) glEnable(GL_CULL_FACE);  // of what is cut the inside is seen
  for (const Part& part : opaque) draw_part(picture, part, 1.0f);
  glDisable(GL_CULL_FACE);
  draw_attachments(picture);
  glDisable(GL_CLIP_DISTANCE0);
  draw_fibres(picture);
  draw_lines_and_tools(picture);
  if (cut) glEnable(GL_CLIP_DISTANCE0);
  limb_program_.use();
  glEnable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  std::for_each(clear.rbegin(), clear.rend(),
                [&](const Part& part) { draw_part(picture, part, picture.opacity(part)); });
  glDepthMask(GL_TRUE);
  glDisable(GL_CULL_FACE);
  glDisable(GL_CLIP_DISTANCE0);
}

void SceneRenderer::draw_part(const Picture& picture, const Part& part, float opacity) {
  const bool bone = part.kind == PartKind::Bone;
  const MuscleTint tint = bone ? MuscleTint{} : picture.tints[static_cast<std::size_t>(part.index)];
  const glm::vec3 belly = belly_colour(part.index);
  limb_program_.set("world_from_model", limb_.pose_of(part));
  limb_program_.set("tissues[0]", bone ? kBoneColour : belly);
  limb_program_.set("tissues[1]", bone ? kBoneColour : kTendonColour);
  limb_program_.set("overlay", glm::vec4(tint.colour, tint.share));
  limb_program_.set("mapped_share", !bone && !levels_.empty() ? kMapShare : 0.0f);
  limb_program_.set("opacity", opacity);
  limb_program_.set("finish", glm::vec4(tint.stripe_m, bone ? kBoneGloss : kMuscleGloss,
                                        picture.view.section.on ? 1.0f : 0.0f, bone ? 0.0f : 1.0f));
  limb_.draw(part);
  ++statistics_.draw_calls;
}

void SceneRenderer::draw_attachments(const Picture& picture) {
  if (!picture.view.attachments) return;
  limb_program_.set("world_from_model", glm::mat4(1.0f));
  limb_program_.set("show_ends", 1.0f);
  limb_program_.set("finish", glm::vec4(0.0f));
  limb_program_.set("overlay", glm::vec4(0.0f));
  limb_program_.set("mapped_share", 0.0f);
  limb_program_.set("opacity", 1.0f);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-2.0f, -2.0f);  // before the bone that they lie on
  std::vector<bool> shown;
  for (int m = 0; m < static_cast<int>(specimen_->muscles.size()); ++m) {
    shown.push_back(picture.shows_attachments(m) && picture.opacity({PartKind::Muscle, m}) > kLeast);
  }
  statistics_.draw_calls += limb_.draw_attachments(shown);
  glDisable(GL_POLYGON_OFFSET_FILL);
  limb_program_.set("show_ends", 0.0f);
}

void SceneRenderer::draw_fibres(const Picture& picture) {
  if (!picture.view.fibres) return;
  scratch_.vertices.clear();
  scratch_.indices.clear();
  const glm::vec3 eye_m = picture.view.camera.eye_world_m();
  for (std::size_t m = 0; m < strokes_.size(); ++m) {
    if (picture.muscles[m] < kSolidOpacity) continue;
    for (const FibreStroke& stroke : strokes_[m]) {
      const LimbSurfaces::StrokeNow now = limb_.stroke_now(static_cast<int>(m), stroke);
      const float facing = glm::dot(now.normal, glm::normalize(eye_m - now.from_m));
      if (facing <= 0.0f || !is_kept(picture.kept, now.from_m)) continue;
      const auto start = static_cast<std::uint32_t>(scratch_.vertices.size());
      const glm::vec4 colour(glm::vec3(kFibre), kFibre.a * std::min(1.0f, 2.0f * facing));
      scratch_.vertices.push_back({now.from_m, now.normal, colour});
      scratch_.vertices.push_back({now.to_m, now.normal, colour});
      scratch_.indices.insert(scratch_.indices.end(), {start, start + 1});
    }
  }
  flat_program_.use();
  flat_program_.set("clip_from_world", picture.clip_from_world);
  upload_and_draw(fibres_, GL_LINES);
}

/// What of them lies inside the limb shines through it.
void SceneRenderer::draw_lines_and_tools(const Picture& picture) {
  surface_program_.use();
  surface_program_.set("clip_from_world", picture.clip_from_world);
  surface_program_.set("eye_world", picture.view.camera.eye_world_m());
  surface_program_.set("key_world", key_light_of(picture.view.camera));
  surface_program_.set("opacity", 1.0f);
  scratch_.vertices.clear();
  scratch_.indices.clear();
  for (std::size_t m = 0; m < picture.frame.lines_world_m.size() && picture.view.lines; ++m) {
    if (m < picture.muscles.size() && picture.muscles[m] <= kLeast) continue;
    const auto& line = picture.frame.lines_world_m[m];
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      add_thread(scratch_, to_glm(line[i]), to_glm(line[i + 1]), kLineRadius_m, kLine);
    }
  }
  for (const auto& spring : picture.frame.springs_world_m) add_spring(scratch_, to_glm(spring[0]), to_glm(spring[1]));
  upload_and_draw(lines_, GL_TRIANGLES);
  scratch_.vertices.clear();
  scratch_.indices.clear();
  const glm::vec3 middle_m = 0.5f * (box_.lowest_m + box_.highest_m);
  for (std::size_t t = 0; t < picture.frame.tools.size(); ++t) {
    const messages::ToolFrame& tool = picture.frame.tools[t];
    const auto& force_only = picture.extras.shows_force_only;
    if (t < force_only.size() && force_only[t]) {
      add_tool_held_back(scratch_, tool, picture.frame, middle_m);
    } else {
      add_tool(scratch_, tool, middle_m);
    }
  }
  upload_and_draw(tools_, GL_TRIANGLES);
  surface_program_.set("opacity", kSeenThroughLine);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  draw_again(lines_, GL_TRIANGLES);
  draw_again(tools_, GL_TRIANGLES);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
}

/// Round the whole part, also where others hide it: where the grown part covers more than the part itself.
void SceneRenderer::draw_outline(const Picture& picture, const Part& part, const glm::vec4& colour, float width_px) {
  const auto& opacities = part.kind == PartKind::Bone ? picture.bones : picture.muscles;
  if (static_cast<std::size_t>(part.index) >= opacities.size() || picture.opacity(part) <= kLeast) return;
  const glm::vec3 half(0.5f * static_cast<float>(picture.viewport.width),
                       0.5f * static_cast<float>(picture.viewport.height), 0.0f);
  outline_program_.use();
  outline_program_.set("world_from_model", limb_.pose_of(part));
  outline_program_.set("clip_from_world", picture.clip_from_world);
  outline_program_.set("kept", picture.kept);
  outline_program_.set("colour", colour);
  if (picture.view.section.on) glEnable(GL_CLIP_DISTANCE0);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_STENCIL_TEST);
  glClear(GL_STENCIL_BUFFER_BIT);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glStencilFunc(GL_ALWAYS, 1, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  outline_program_.set("grow", half);
  limb_.draw(part);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glStencilFunc(GL_NOTEQUAL, 1, 0xff);
  // Each pixel once, though the grown part's far side covers it too.
  outline_program_.set("grow", half + glm::vec3(0.0f, 0.0f, picture.extras.stroke_scale * width_px));
  limb_.draw(part);
  glDisable(GL_STENCIL_TEST);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CLIP_DISTANCE0);
  statistics_.draw_calls += 2;
}

void SceneRenderer::draw_marks(const Picture& picture) {
  if (picture.extras.marks.empty()) return;
  scratch_.vertices.clear();
  scratch_.indices.clear();
  for (const SceneMark& mark : picture.extras.marks) {
    add_sphere(scratch_, mark.place_world_m, mark.radius_m, mark.colour);
  }
  surface_program_.use();
  surface_program_.set("opacity", 1.0f);
  glDisable(GL_DEPTH_TEST);
  upload_and_draw(marks_, GL_TRIANGLES);
  glEnable(GL_DEPTH_TEST);
}

void SceneRenderer::upload_and_draw(Drawable& drawable, unsigned mode) {
  statistics_.uploaded_bytes += drawable.upload(scratch_);
  draw_again(drawable, mode);
}

void SceneRenderer::draw_again(const Drawable& drawable, unsigned mode) {
  if (drawable.empty()) return;
  drawable.draw(mode);
  ++statistics_.draw_calls;
}

}  // namespace myotact::view
