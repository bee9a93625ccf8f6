#include "view/render/drawable.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <epoxy/gl.h>

namespace myotact::view {

namespace {

constexpr int kAround = 16, kAroundThread = 6;

/// Two unit vectors that make a right-handed frame with `axis`.
std::pair<glm::vec3, glm::vec3> across(const glm::vec3& axis) {
  const glm::vec3 other = std::abs(axis.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  const glm::vec3 u = glm::normalize(glm::cross(axis, other));
  return {u, glm::cross(axis, u)};
}

struct Ring {
  glm::vec3 centre;
  float radius;
  float slope = 0.0f;  // of the normals along the axis
  int around = kAround;
};

/// A ring of vertices and, from the second ring on, the quads to the ring before.
void add_ring(DrawMesh& mesh, const Ring& ring, const glm::vec3& axis, const glm::vec4& colour, bool join) {
  const auto [u, v] = across(axis);
  const auto start = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int j = 0; j < ring.around; ++j) {
    const float t = 2.0f * std::numbers::pi_v<float> * static_cast<float>(j) / static_cast<float>(ring.around);
    const glm::vec3 out = std::cos(t) * u + std::sin(t) * v;
    mesh.vertices.push_back({ring.centre + ring.radius * out, glm::normalize(out + ring.slope * axis), colour});
  }
  if (!join) return;
  const auto around = static_cast<std::uint32_t>(ring.around);
  for (std::uint32_t j = 0; j < around; ++j) {
    const std::uint32_t next = (j + 1) % around;
    const std::uint32_t a = start - around + j, b = start - around + next, c = start + j, d = start + next;
    mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
  }
}

}  // namespace

Drawable::~Drawable() {
  if (array_ == 0) return;
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
}

Drawable::Drawable(Drawable&& other) noexcept
    : array_(std::exchange(other.array_, 0)),
      vertices_(std::exchange(other.vertices_, 0)),
      indices_(std::exchange(other.indices_, 0)),
      count_(std::exchange(other.count_, 0)) {}

std::size_t Drawable::upload(const DrawMesh& mesh) {
  if (array_ == 0) {
    glGenVertexArrays(1, &array_);
    glGenBuffers(1, &vertices_);
    glGenBuffers(1, &indices_);
  }
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(DrawVertex)),
               mesh.vertices.data(), GL_STREAM_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
               mesh.indices.data(), GL_STREAM_DRAW);
  const auto attribute = [](GLuint place, int size, std::size_t offset) {
    glEnableVertexAttribArray(place);
    glVertexAttribPointer(place, size, GL_FLOAT, GL_FALSE, sizeof(DrawVertex), reinterpret_cast<const void*>(offset));
  };
  attribute(0, 3, offsetof(DrawVertex, position));
  attribute(1, 3, offsetof(DrawVertex, normal));
  attribute(2, 4, offsetof(DrawVertex, colour));
  count_ = static_cast<int>(mesh.indices.size());
  return mesh.vertices.size() * sizeof(DrawVertex) + mesh.indices.size() * sizeof(std::uint32_t);
}

void Drawable::draw(unsigned mode) const {
  if (count_ == 0) return;
  glBindVertexArray(array_);
  glDrawElements(mode, count_, GL_UNSIGNED_INT, nullptr);
}

void add_sphere(DrawMesh& mesh, const glm::vec3& centre_m, float radius_m, const glm::vec4& colour) {
  constexpr int kRings = 10;
  const glm::vec3 axis(0, 0, 1);
  for (int i = 0; i <= kRings; ++i) {
    const float t = std::numbers::pi_v<float> * static_cast<float>(i) / kRings - 0.5f * std::numbers::pi_v<float>;
    const float radius = std::max(std::cos(t), 1e-3f);
    add_ring(mesh, {centre_m + radius_m * std::sin(t) * axis, radius_m * radius, std::tan(t * 0.999f)}, axis, colour,
             i > 0);
  }
}

void add_tube(DrawMesh& mesh, const glm::vec3& from_m, const glm::vec3& to_m, float radius_m, const glm::vec4& colour) {
  const float length = glm::length(to_m - from_m);
  if (length < 1e-7f) return;
  const glm::vec3 axis = (to_m - from_m) / length;
  add_ring(mesh, {from_m, radius_m}, axis, colour, false);
  add_ring(mesh, {to_m, radius_m}, axis, colour, true);
}

void add_thread(DrawMesh& mesh, const glm::vec3& from_m, const glm::vec3& to_m, float radius_m,
                const glm::vec4& colour) {
  const float length = glm::length(to_m - from_m);
  if (length < 1e-7f) return;
  const glm::vec3 axis = (to_m - from_m) / length;
  add_ring(mesh, {from_m, radius_m, 0.0f, kAroundThread}, axis, colour, false);
  add_ring(mesh, {to_m, radius_m, 0.0f, kAroundThread}, axis, colour, true);
}

void add_cone(DrawMesh& mesh, const glm::vec3& from_m, const glm::vec3& to_m, const EndRadii& radii,
              const glm::vec4& colour) {
  const float length = glm::length(to_m - from_m);
  if (length < 1e-7f) return;
  const glm::vec3 axis = (to_m - from_m) / length;
  const float slope = (radii.from_m - radii.to_m) / length;
  add_ring(mesh, {from_m, radii.from_m, slope}, axis, colour, false);
  add_ring(mesh, {to_m, radii.to_m, slope}, axis, colour, true);
}

void add_arrow(DrawMesh& mesh, const glm::vec3& from_m, const glm::vec3& to_m, float radius_m,
               const glm::vec4& colour) {
  const float length = glm::length(to_m - from_m);
  if (length < 1e-6f) return;
  const glm::vec3 axis = (to_m - from_m) / length;
  const float head = std::min(6.0f * radius_m, 0.6f * length);
  const glm::vec3 neck = to_m - head * axis;
  add_tube(mesh, from_m, neck, radius_m, colour);
  add_ring(mesh, {neck, 2.5f * radius_m, 0.4f}, axis, colour, false);
  add_ring(mesh, {to_m, 0.01f * radius_m, 0.4f}, axis, colour, true);
}

}  // namespace myotact::view
