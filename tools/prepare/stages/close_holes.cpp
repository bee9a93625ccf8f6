#include "prepare/stages/close_holes.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "prepare/field/level_set.h"
#include "prepare/field/signed_distance.h"
#include "prepare/part/film.h"
#include "prepare/remesh/decimate.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

/// Muscles of less mean thickness (two volumes over the area) are looked at [steps]. Closing thicker ones leaves most
/// with several times as many triangles and no fewer handles (tests/bench/results/2026-12-01-holes.md).
constexpr double kThin = 3.0;
/// How far the skin is moved out and back [steps]: holes up to twice as wide are filled.
constexpr double kReaches[] = {1.0, 0.75};
/// Spacing of the lattice that both are looked at on [steps].
constexpr double kSpacing = 0.5;
/// The volume may change by this part; more has been lost than a few holes.
constexpr double kSameVolume = 0.05;
/// As skins that are cut from a volume (cut_parts.cpp) [steps].
constexpr double kEdge = 6.75, kTolerance = 0.3;

/// Nothing when there is none.
geometry::TriangleMesh largest_piece(const geometry::TriangleMesh& surface) {
  const std::vector<geometry::TriangleMesh> pieces = pieces_of(surface);
  if (pieces.empty()) return {};
  return *std::max_element(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) {
    return geometry::enclosed_volume_m3(a) < geometry::enclosed_volume_m3(b);
  });
}

geometry::TriangleMesh closing(const SignedDistance& distance, double reach_m, double spacing_m) {
  Eigen::AlignedBox3d box = distance.box();
  box.min().array() -= reach_m + 2.0 * spacing_m;
  box.max().array() += reach_m + 2.0 * spacing_m;
  const SignedDistance moved_out(
      largest_piece(extract_level_set([&](const Vec3& p) { return distance(p) - reach_m; }, box, spacing_m)));
  // Nothing of the muscle is lost, but for what the spacing does not show: all of it, where it is that thin.
  const BodyField back = [&](const Vec3& p) { return std::min(moved_out(p) + reach_m, distance(p)); };
  return largest_piece(extract_level_set(back, box, spacing_m));
}

}  // namespace

geometry::TriangleMesh close_holes(const geometry::TriangleMesh& skin, double step_m) {
  const int torn = genus(skin);
  const double volume_m3 = geometry::enclosed_volume_m3(skin);
  if (torn == 0 || 2.0 * volume_m3 > kThin * step_m * geometry::surface_area_m2(skin)) return skin;
  const SignedDistance distance(skin);
  geometry::TriangleMesh best;
  int fewest = torn;
  for (const double reach : kReaches) {
    const geometry::TriangleMesh closed = closing(distance, reach * step_m, kSpacing * step_m);
    const double change = geometry::enclosed_volume_m3(closed) / volume_m3 - 1.0;
    if (std::abs(change) > kSameVolume || genus(closed) >= fewest) continue;
    best = closed;
    fewest = genus(closed);
  }
  if (fewest == torn) return skin;
  return decimate(best, {kEdge * step_m, kTolerance * step_m});
}

}  // namespace myotact::prepare
