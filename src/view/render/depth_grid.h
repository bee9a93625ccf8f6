#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace myotact::view {

/// A small picture of depths, drawn without any graphics card: for questions like "what is seen from there". A cell is
/// covered by a triangle that holds its middle.
class DepthGrid {
 public:
  static constexpr int kNobody = -1;

  DepthGrid(int width, int height);

  void clear();
  /// A triangle with corners x, y [cells, from the first cell's edge] and z, its depth: nearer is smaller. Keeps what
  /// is nearest, and whose it is.
  void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, int owner);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Of a cell; infinity where nothing was drawn.
  float depth(int x, int y) const { return depths_[cell(x, y)]; }
  int owner(int x, int y) const { return owners_[cell(x, y)]; }

 private:
  std::size_t cell(int x, int y) const { return static_cast<std::size_t>(y * width_ + x); }

  int width_, height_;
  std::vector<float> depths_;
  std::vector<int> owners_;
};

}  // namespace myotact::view
