#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/look/camera.h"
#include "view/look/limb_bounds.h"
#include "view/look/part.h"
#include "view/look/view_state.h"
#include "view/render/drawable.h"
#include "view/render/fibre_strokes.h"
#include "view/render/gl_program.h"
#include "view/render/limb_surfaces.h"
#include "view/render/muscle_colour.h"
#include "view/render/scene_mark.h"

namespace myotact::view {

/// A part of the framebuffer [pixels, from its bottom left corner].
struct Viewport {
  int x = 0, y = 0, width = 1, height = 1;
};

/// What is shown in the scene besides frame and view.
struct SceneExtras {
  Part hovered;   // by the pointer
  int joint = 0;  // whose stiffness is shared out among the muscles
  std::span<const SceneMark> marks;
  std::span<const std::vector<float>> pressures_Pa;  // muscles x skin vertices, for MuscleColour::Pressure
  std::vector<bool> shows_force_only;                // as in SceneFacts
  glm::vec3 background{0.955f, 0.96f, 0.965f};
  bool legend = true;         // of the colours, where there is text
  float stroke_scale = 1.0f;  // of widths in pixels: more for a picture that is printed at many
};

/// What the last picture took.
struct RenderStatistics {
  int draw_calls = 0;
  std::size_t uploaded_bytes = 0;
  double frame_ms = 0.0;  // of draw() itself; the graphics card may still be at work
};

/// Draws bones, muscles, muscle lines, fibres, tools with their force arrows, and marks into the bound framebuffer,
/// which needs a stencil buffer for outlines. Needs a current OpenGL 3.3 core context from first to last.
class SceneRenderer {
 public:
  explicit SceneRenderer(const anatomy::Specimen& specimen);

  void draw(const messages::SceneFrame& frame, const ViewState& view, const Viewport& viewport,
            const SceneExtras& extras = {});

  const RenderStatistics& statistics() const { return statistics_; }
  /// Muscles of the superficial layer, as in the specimen.
  const std::vector<bool>& superficial() const { return limb_.superficial(); }

 private:
  /// What the passes over one picture share.
  struct Picture;

  void begin(const Picture& picture);
  void move_limb(const Picture& picture);
  void draw_limb(const Picture& picture);
  void draw_part(const Picture& picture, const Part& part, float opacity);
  void draw_attachments(const Picture& picture);
  void draw_fibres(const Picture& picture);
  void draw_lines_and_tools(const Picture& picture);
  void draw_outline(const Picture& picture, const Part& part, const glm::vec4& colour, float width_px);
  void draw_marks(const Picture& picture);
  void upload_and_draw(Drawable& drawable, unsigned mode);
  void draw_again(const Drawable& drawable, unsigned mode);

  const anatomy::Specimen* specimen_;
  ViewBox box_;  // at the file pose
  GlProgram limb_program_, outline_program_, surface_program_, flat_program_;
  LimbSurfaces limb_;
  std::vector<std::vector<FibreStroke>> strokes_;  // of the muscles
  std::vector<std::vector<float>> levels_;         // of pressure
  Drawable lines_, tools_, marks_, fibres_, grid_, shadow_;
  DrawMesh scratch_;
  RenderStatistics statistics_;
};

}  // namespace myotact::view
