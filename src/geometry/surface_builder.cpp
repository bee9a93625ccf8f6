#include "geometry/surface_builder.h"

#include <fmt/format.h>

namespace myotact::geometry {

void SurfaceBuilder::add_position(const Vec3& position_m) {
  if (position_count() == kMostMeshElements) {
    throw words_.error(fmt::format("there are more than {} vertices; simplify the surface", kMostMeshElements));
  }
  surface_.mesh.positions_m.push_back(position_m);
}

void SurfaceBuilder::require_face(std::size_t corners) const {
  if (corners >= 3 && corners <= kMostCorners) return;
  throw words_.error(fmt::format("a face has {} corners; must have 3 to {}", corners, kMostCorners));
}

void SurfaceBuilder::add_face(std::span<const int> corners) {
  require_face(corners.size());
  if (surface_.mesh.triangles.size() + corners.size() - 2 > static_cast<std::size_t>(kMostMeshElements)) {
    throw words_.error(fmt::format("there are more than {} triangles; simplify the surface", kMostMeshElements));
  }
  crossed_ += cutter_.cut(corners, surface_.mesh) ? 0 : 1;
}

SurfaceFile SurfaceBuilder::take() {
  if (surface_.mesh.triangles.empty()) throw words_.error("the file holds no triangles");
  if (crossed_ > 0) {
    add_note(fmt::format("{} of its faces cross themselves, so that their triangles overlap", crossed_));
  }
  return std::move(surface_);
}

}  // namespace myotact::geometry
