#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/look/part.h"
#include "view/render/fibre_strokes.h"
#include "view/render/seam_normals.h"
#include "view/render/sky_exposure.h"
#include "view/render/surface_set.h"

namespace myotact::view {

/// The specimen's bones and skins on the graphics card. Needs a current OpenGL context from first to last.
class LimbSurfaces {
 public:
  explicit LimbSurfaces(const anatomy::Specimen& specimen);

  /// Skins as they are in the frame, bones where they stand. `levels`: muscles x skin vertices, 0 .. 1, or empty.
  /// Returns the bytes sent.
  std::size_t move(const messages::SceneFrame& frame, std::span<const std::vector<float>> levels);

  void draw(const Part& part) const;
  /// Only the triangles of the attachment areas, at both ends, of these muscles. Returns the draw calls.
  int draw_attachments(const std::vector<bool>& muscles) const;

  const glm::mat4& pose_of(const Part& part) const;
  const glm::vec3& middle_world_m(const Part& part) const;
  /// Ends of a stroke on a muscle as it is now, a little above the skin, and the skin's unit normal there.
  struct StrokeNow {
    glm::vec3 from_m, to_m, normal;
  };
  StrokeNow stroke_now(int muscle, const FibreStroke& stroke) const;
  const std::vector<bool>& superficial() const { return superficial_; }

 private:
  void add_muscle(std::size_t m, const LimbShade::Vertices& shade, std::vector<FixedVertex>& fixed,
                  std::vector<std::uint32_t>& indices);
  void add_tissue(std::size_t m, std::vector<FixedVertex>& fixed);
  void add_attachments(std::size_t m, const std::vector<FixedVertex>& fixed, std::vector<std::uint32_t>& indices);
  void prepare_bones(const LimbShade& shade);
  void pack(std::size_t vertex, float level);

  const anatomy::Specimen* specimen_;
  SurfaceSet skins_, bones_;
  std::vector<SurfaceSet::Run> muscle_runs_, bone_runs_, attachment_runs_;
  std::vector<std::size_t> first_vertex_;  // of a muscle
  // Of all skins, as they are now:
  std::vector<glm::vec3> positions_m_, normals_;
  std::vector<MovingVertex> moving_;
  SeamNormals seams_;
  std::vector<std::array<std::uint32_t, 2>> along_;  // of all skins: the vertices ahead and behind along the fibres
  std::vector<glm::mat4> poses_;                     // of bones
  std::vector<glm::vec3> bone_middles_m_, muscle_middles_world_m_, bone_middles_world_m_;
  std::vector<bool> superficial_;
};

}  // namespace myotact::view
