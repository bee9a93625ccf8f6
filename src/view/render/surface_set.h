#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace myotact::view {

/// What of a vertex moves, packed: a limb has some hundred thousand of them.
struct MovingVertex {
  glm::vec3 position{0.0f};
  std::array<std::int16_t, 4> normal_and_value{};  // 1 is 32767; the value: 0 .. 1, of a map on the skin
  std::array<std::int8_t, 4> along{};              // direction of the fibres, 1 is 127; 0: none. The last is unused.
};

/// Of vectors that are no longer than 1.
std::array<std::int16_t, 4> packed(const glm::vec3& normal, float value);
std::array<std::int8_t, 4> packed(const glm::vec3& along);

/// What of a vertex stays as it is.
struct FixedVertex {
  float alone = 1.0f, together = 1.0f;  // exposure to the sky
  float along_m = 0.0f;                 // along the muscle
  float origin = 0.0f, insertion = 0.0f;
  float tendon = 0.0f;       // 0 belly .. 1 tendon
  glm::vec3 strand_m{0.0f};  // strand_coordinates()
};

/// Vertices and triangles of all surfaces of a kind in one buffer on the graphics card: triangles and what stays are
/// uploaded once, what moves as often as asked. Attribute places as in shaders/limb.vert. Needs a current OpenGL
/// context from first to last.
class SurfaceSet {
 public:
  /// A run of triangles: of one part, or of some of its triangles.
  struct Run {
    int first = 0, count = 0;  // indices
  };

  SurfaceSet() = default;
  ~SurfaceSet();
  SurfaceSet(const SurfaceSet&) = delete;
  SurfaceSet& operator=(const SurfaceSet&) = delete;

  /// Once. `indices` into the vertices of all surfaces together.
  void prepare(std::span<const FixedVertex> fixed, std::span<const std::uint32_t> indices);
  /// As many as fixed ones. Returns the bytes sent.
  std::size_t move(std::span<const MovingVertex> moving);
  void draw(const Run& run) const;

 private:
  unsigned array_ = 0;
  unsigned buffers_[3] = {0, 0, 0};  // moving, fixed, indices
};

}  // namespace myotact::view
