#include <algorithm>

#include "geometry/triangle_tree.h"
#include "prepare/field/level_set.h"
#include "prepare/field/winding_number.h"
#include "prepare/repair/stages.h"
#include "prepare/repair/surface_pieces.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Of the lattice, in multiples of how far the surface may move: edges come out rounded by a part of it, and the result
/// is measured.
constexpr double kSpacing = 2.0;

/// Whether a place of the surface is to vanish: the surface winds round none of the places a little off it.
bool vanishes(const WindingNumber& winding, const Vec3& p, double reach) {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3 step(x, y, z);
        if (step != Vec3::Zero() && winding(p + reach * step.normalized()) > 0.5) return false;
      }
    }
  }
  return true;
}

TriangleMesh largest_piece(const TriangleMesh& surface) {
  TriangleMesh largest;
  for (TriangleMesh& piece : pieces_of(surface)) {
    if (piece.triangles.size() > largest.triangles.size()) largest = std::move(piece);
  }
  return largest;
}

}  // namespace

std::optional<TriangleMesh> resample(const TriangleMesh& piece, double tolerance) {
  const WindingNumber winding(piece);
  // Quickly told, unlike the distances at the end: what is inside out would be lost.
  if (std::any_of(piece.positions_m.begin(), piece.positions_m.end(),
                  [&](const Vec3& p) { return vanishes(winding, p, tolerance); })) {
    return std::nullopt;
  }
  const geometry::TriangleTree tree(piece);
  const auto inside_is_negative = [&](const Vec3& p) {
    const double distance = tree.nearest(p, piece.positions_m).distance_m;
    return winding(p) > 0.5 ? -distance : distance;
  };
  Eigen::AlignedBox3d box;
  for (const Vec3& p : piece.positions_m) box.extend(p);
  return largest_piece(extract_level_set(inside_is_negative, box, kSpacing * tolerance));
}

}  // namespace myotact::prepare
