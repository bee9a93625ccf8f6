#include <algorithm>

#include "prepare/field/winding_number.h"
#include "prepare/repair/stages.h"

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

}  // namespace

std::optional<TriangleMesh> resample(const TriangleMesh& piece, double tolerance) {
  const WindingNumber winding(piece);
  // Quickly checked, unlike the distances at the end: what is inside out would be lost.
  if (std::any_of(piece.positions_m.begin(), piece.positions_m.end(),
                  [&](const Vec3& p) { return vanishes(winding, p, tolerance); })) {
    return std::nullopt;
  }
  return surface_of_winding(piece, kSpacing * tolerance);
}

}  // namespace myotact::prepare
