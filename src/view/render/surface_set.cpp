#include "view/render/surface_set.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <epoxy/gl.h>

namespace myotact::view {

namespace {

/// Whole numbers stand for shares of their largest.
void attribute(GLuint place, int size, GLenum type, std::size_t stride, std::size_t offset) {
  glEnableVertexAttribArray(place);
  glVertexAttribPointer(place, size, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE, static_cast<GLsizei>(stride),
                        reinterpret_cast<const void*>(offset));
}

template <typename Whole>
Whole packed_share(float share) {
  constexpr auto kOne = static_cast<float>(std::numeric_limits<Whole>::max());
  return static_cast<Whole>(std::lround(std::clamp(share, -1.0f, 1.0f) * kOne));
}

template <typename Item>
void send(GLenum target, std::span<const Item> items, GLenum usage) {
  glBufferData(target, static_cast<GLsizeiptr>(items.size_bytes()), items.data(), usage);
}

}  // namespace

std::array<std::int16_t, 4> packed(const glm::vec3& normal, float value) {
  return {packed_share<std::int16_t>(normal.x), packed_share<std::int16_t>(normal.y),
          packed_share<std::int16_t>(normal.z), packed_share<std::int16_t>(value)};
}

std::array<std::int8_t, 4> packed(const glm::vec3& along) {
  return {packed_share<std::int8_t>(along.x), packed_share<std::int8_t>(along.y), packed_share<std::int8_t>(along.z),
          0};
}

SurfaceSet::~SurfaceSet() {
  if (array_ == 0) return;
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(3, buffers_);
}

void SurfaceSet::prepare(std::span<const FixedVertex> fixed, std::span<const std::uint32_t> indices) {
  glGenVertexArrays(1, &array_);
  glGenBuffers(3, buffers_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
  attribute(0, 3, GL_FLOAT, sizeof(MovingVertex), offsetof(MovingVertex, position));
  attribute(1, 4, GL_SHORT, sizeof(MovingVertex), offsetof(MovingVertex, normal_and_value));
  attribute(2, 4, GL_BYTE, sizeof(MovingVertex), offsetof(MovingVertex, along));
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[1]);
  send(GL_ARRAY_BUFFER, fixed, GL_STATIC_DRAW);
  attribute(3, 2, GL_FLOAT, sizeof(FixedVertex), offsetof(FixedVertex, alone));
  attribute(4, 4, GL_FLOAT, sizeof(FixedVertex), offsetof(FixedVertex, along_m));  // and the three after it
  attribute(5, 3, GL_FLOAT, sizeof(FixedVertex), offsetof(FixedVertex, strand_m));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[2]);
  send(GL_ELEMENT_ARRAY_BUFFER, indices, GL_STATIC_DRAW);
  glBindVertexArray(0);
}

std::size_t SurfaceSet::move(std::span<const MovingVertex> moving) {
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
  send(GL_ARRAY_BUFFER, moving, GL_STREAM_DRAW);
  return moving.size_bytes();
}

void SurfaceSet::draw(const Run& run) const {
  glBindVertexArray(array_);
  glDrawElements(GL_TRIANGLES, run.count, GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(static_cast<std::size_t>(run.first) * sizeof(std::uint32_t)));
}

}  // namespace myotact::view
