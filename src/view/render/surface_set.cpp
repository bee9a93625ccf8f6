#include "view/render/surface_set.h"

#include <cstddef>

#include <epoxy/gl.h>

namespace myotact::view {

namespace {

void attribute(GLuint place, int size, std::size_t stride, std::size_t offset) {
  glEnableVertexAttribArray(place);
  glVertexAttribPointer(place, size, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                        reinterpret_cast<const void*>(offset));
}

template <typename Item>
void send(GLenum target, std::span<const Item> items, GLenum usage) {
  glBufferData(target, static_cast<GLsizeiptr>(items.size_bytes()), items.data(), usage);
}

}  // namespace

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
  attribute(0, 3, sizeof(MovingVertex), offsetof(MovingVertex, position));
  attribute(1, 3, sizeof(MovingVertex), offsetof(MovingVertex, normal));
  attribute(2, 1, sizeof(MovingVertex), offsetof(MovingVertex, value));
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[1]);
  send(GL_ARRAY_BUFFER, fixed, GL_STATIC_DRAW);
  attribute(3, 2, sizeof(FixedVertex), offsetof(FixedVertex, alone));
  attribute(4, 1, sizeof(FixedVertex), offsetof(FixedVertex, along_m));
  attribute(5, 2, sizeof(FixedVertex), offsetof(FixedVertex, origin));
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
