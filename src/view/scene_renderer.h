#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/camera.h"
#include "view/drawable.h"
#include "view/gl_program.h"
#include "view/limb_bounds.h"
#include "view/scene_mark.h"

namespace myotact::view {

/// A part of the framebuffer [pixels, from its bottom left corner].
struct Viewport {
  int x = 0, y = 0, width = 1, height = 1;
};

/// Draws bones, muscles coloured by activation, muscle lines, tools with their force arrows and marks into the bound
/// framebuffer.
/// Needs a current OpenGL 3.3 core context from first to last.
class SceneRenderer {
 public:
  explicit SceneRenderer(const anatomy::Specimen& specimen);

  void draw(const messages::SceneFrame& frame, const Camera& camera, const Viewport& viewport,
            const std::vector<SceneMark>& marks = {});

 private:
  void draw_bones(const messages::SceneFrame& frame);
  void draw_muscles(const messages::SceneFrame& frame);
  void draw_lines_and_tools(const messages::SceneFrame& frame);
  void draw_marks(const std::vector<SceneMark>& marks);

  const anatomy::Specimen* specimen_;
  glm::vec3 middle_m_{0.0f};  // of the specimen
  GlProgram surface_, flat_;
  std::vector<Drawable> bones_;
  std::vector<Drawable> muscles_;
  Drawable overlay_, grid_;
  DrawMesh scratch_;
};

}  // namespace myotact::view
