#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace myotact::view {

struct DrawVertex {
  glm::vec3 position;
  glm::vec3 normal{0.0f, 0.0f, 1.0f};
  glm::vec4 colour{1.0f};
};

/// Triangles (or lines) to draw, on the side of the program.
struct DrawMesh {
  std::vector<DrawVertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// The same on the side of the graphics card. Needs a current OpenGL context from first to last.
class Drawable {
 public:
  Drawable() = default;
  ~Drawable();
  Drawable(const Drawable&) = delete;
  Drawable& operator=(const Drawable&) = delete;
  Drawable(Drawable&& other) noexcept;

  /// Returns the bytes sent.
  std::size_t upload(const DrawMesh& mesh);
  bool empty() const { return count_ == 0; }
  /// `mode`: GL_TRIANGLES or GL_LINES.
  void draw(unsigned mode) const;

 private:
  unsigned array_ = 0, vertices_ = 0, indices_ = 0;
  int count_ = 0;
};

// Shapes, appended to a mesh; world metres.
void add_sphere(DrawMesh& mesh, const glm::vec3& centre_m, float radius_m, const glm::vec4& colour);
void add_tube(DrawMesh& mesh, const glm::vec3& from_m, const glm::vec3& to_m, float radius_m, const glm::vec4& colour);
/// A tube so thin that six sides look round.
void add_thread(DrawMesh& mesh, const glm::vec3& from_m, const glm::vec3& to_m, float radius_m,
                const glm::vec4& colour);
struct EndRadii {
  float from_m = 0.0f, to_m = 0.0f;
};
/// Open at both ends, thinner towards `to_m`.
void add_cone(DrawMesh& mesh, const glm::vec3& from_m, const glm::vec3& to_m, const EndRadii& radii,
              const glm::vec4& colour);
void add_arrow(DrawMesh& mesh, const glm::vec3& from_m, const glm::vec3& to_m, float radius_m, const glm::vec4& colour);

}  // namespace myotact::view
