#include "view/render/depth_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace myotact::view {

namespace {

/// First cell whose middle is not before x, and the last whose middle is not after it, within 0 .. count - 1.
int first_cell(float x, int count) {
  return static_cast<int>(std::ceil(std::clamp(x, 0.0f, static_cast<float>(count) + 1.0f) - 0.5f));
}
int last_cell(float x, int count) {
  return static_cast<int>(std::floor(std::clamp(x, -1.0f, static_cast<float>(count)) - 0.5f));
}

}  // namespace

DepthGrid::DepthGrid(int width, int height) : width_(width), height_(height) {
  const auto cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  depths_.resize(cells);
  owners_.resize(cells);
  clear();
}

void DepthGrid::clear() {
  std::fill(depths_.begin(), depths_.end(), std::numeric_limits<float>::infinity());
  std::fill(owners_.begin(), owners_.end(), kNobody);
}

void DepthGrid::add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, int owner) {
  const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (!(std::abs(area) > 1e-12f) || !std::isfinite(area)) return;  // seen from its edge, or not a number
  const int x0 = first_cell(std::min({a.x, b.x, c.x}), width_), x1 = last_cell(std::max({a.x, b.x, c.x}), width_);
  const int y0 = first_cell(std::min({a.y, b.y, c.y}), height_), y1 = last_cell(std::max({a.y, b.y, c.y}), height_);
  if (x0 > x1 || y0 > y1) return;  // between the middles of cells, as most triangles of a fine surface
  // Shares of b and c at (x, y), and the depth, are linear in x and y.
  const glm::vec2 b_slope((c.y - a.y) / area, -(c.x - a.x) / area), c_slope(-(b.y - a.y) / area, (b.x - a.x) / area);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const glm::vec2 from_a(static_cast<float>(x) + 0.5f - a.x, static_cast<float>(y) + 0.5f - a.y);
      const float of_b = glm::dot(b_slope, from_a), of_c = glm::dot(c_slope, from_a);
      if (of_b < 0.0f || of_c < 0.0f || of_b + of_c > 1.0f) continue;
      const float z = a.z + of_b * (b.z - a.z) + of_c * (c.z - a.z);
      const std::size_t here = cell(x, y);
      if (z >= depths_[here]) continue;
      depths_[here] = z;
      owners_[here] = owner;
    }
  }
}

}  // namespace myotact::view
