#include "prepare/tets/cage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"
#include "prepare/field/level_set.h"
#include "prepare/field/winding_number.h"
#include "prepare/remesh/crossing_triangles.h"
#include "prepare/remesh/decimate.h"
#include "prepare/remesh/surface_distance.h"
#include "prepare/tets/smooth_tets.h"
#include "prepare/tets/tetrahedralise.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// One way to make the cage. Where one ends in a flat tet, another does not: thin parts leave little choice of
/// triangles, and small changes lead to others.
struct Variant {
  double edge;         // against the length that the wanted number of tets has
  double least_shape;  // of the triangles that collapses may leave
};
constexpr std::array<Variant, 6> kVariants = {
    {{1.0, 0.3}, {0.94, 0.5}, {1.06, 0.4}, {0.9, 0.3}, {1.12, 0.5}, {0.85, 0.4}}};
/// Cage and fine surface lie at most this part of an edge apart at the samples that are looked at; half an edge then
/// holds between them, too.
constexpr double kTolerance = 0.42;
/// Surface nodes may move by this part of an edge when the tets are smoothed.
constexpr double kSmoothingReach = 0.08;
constexpr double kMostDeviation = 0.5;
constexpr double kVolumeTolerance = 0.01;
/// A cage this good ends the search.
constexpr double kGoodDihedral_deg = 9.0;
constexpr double kGoodFirstPercentile_deg = 14.0;
/// Triangles of a surface that is made anew, roughly; thin bodies get more.
constexpr double kTrianglesAnew = 20000.0;
/// Numbers of tets within these multiples of the wanted one are as good as it.
constexpr double kFewest = 0.75, kMost = 1.45;

/// 1 and more: good in every way.
double score(const Cage& cage, double tets) {
  const double count = static_cast<double>(cage.quality.tets) / tets;
  const double fits = count < kFewest ? count / kFewest : count > kMost ? kMost / count : 1.0;
  return fits * std::min(1.0, std::min(cage.quality.smallest_dihedral_deg / kGoodDihedral_deg,
                                       cage.quality.first_percentile_dihedral_deg / kGoodFirstPercentile_deg));
}

/// The boundary's vertices at their places after smoothing.
void follow_nodes(Cage& cage) {
  std::copy_n(cage.tets.nodes_m.begin(), cage.surface.positions_m.size(), cage.surface.positions_m.begin());
}

/// Nothing when this variant breaks a promise.
std::optional<Cage> try_variant(const std::string& name, const TriangleMesh& fine, double edge_m, double least_shape) {
  const double volume_m3 = geometry::enclosed_volume_m3(fine);
  Cage cage;
  cage.edge_m = edge_m;
  cage.surface = coarsen(fine, {edge_m, kTolerance * edge_m, least_shape});
  try {
    cage.tets = tetrahedralise(name, cage.surface);
  } catch (const Error&) {
    return std::nullopt;  // TetGen gave up on this one
  }
  const geometry::TetMesh rough = cage.tets;
  smooth_tets(cage.tets, cage.surface.positions_m.size(), kSmoothingReach * edge_m);
  const TriangleMesh rough_surface = cage.surface;
  follow_nodes(cage);
  if (!crossing_triangles(cage.surface).empty()) {
    cage.tets = rough;
    cage.surface = rough_surface;
  }
  cage.volume_error = geometry::enclosed_volume_m3(cage.surface) / volume_m3 - 1.0;
  cage.deviation_m = surface_distance(cage.surface, fine).largest_m;
  if (std::abs(cage.volume_error) > kVolumeTolerance || cage.deviation_m > kMostDeviation * edge_m) {
    return std::nullopt;
  }
  cage.quality = measure_tets(cage.tets);
  return cage;
}

/// The first good variant, else the best; nothing when none can be filled.
std::optional<Cage> best_variant(const std::string& name, const TriangleMesh& fine, double tets, int& attempts) {
  double usual_edge_m = edge_for_tets_m(geometry::enclosed_volume_m3(fine), tets);
  std::optional<Cage> best;
  for (const Variant& variant : kVariants) {
    ++attempts;
    std::optional<Cage> cage = try_variant(name, fine, variant.edge * usual_edge_m, variant.least_shape);
    if (!cage) continue;
    if (!best || score(*cage, tets) > score(*best, tets)) best = cage;
    if (score(*best, tets) >= 1.0) break;
    // Thin bodies hold more tets than regular ones would, and their number goes with the square: aim again.
    const double count = static_cast<double>(cage->quality.tets) / tets;
    if (count < kFewest || count > kMost) usual_edge_m = cage->edge_m / variant.edge * std::sqrt(count);
  }
  return best;
}

/// The second route, for surfaces that TetGen refuses in every variant: a new one without anything that could be wrong.
TriangleMesh made_anew(const TriangleMesh& fine) {
  const double area_m2 = geometry::surface_area_m2(fine);
  const double spacing_m = std::min(spacing_for_triangles_m(area_m2, kTrianglesAnew),
                                    spacing_for_thickness_m(area_m2, geometry::enclosed_volume_m3(fine)));
  return surface_of_winding(fine, spacing_m);
}

}  // namespace

double edge_for_tets_m(double volume_m3, double tets) {
  return std::cbrt(6.0 * std::numbers::sqrt2 * volume_m3 / tets);
}

Cage make_cage(const std::string& name, const TriangleMesh& fine, double tets) {
  int attempts = 0;
  std::optional<Cage> best = best_variant(name, fine, tets, attempts);
  if (!best) best = best_variant(name, made_anew(fine), tets, attempts);
  if (!best) {
    throw bad_data(
        name, "tetrahedra",
        fmt::format("no cage of about {:.0f} tets could be filled in {} attempts; ask for more tets", tets, attempts));
  }
  best->attempts = attempts;
  return *best;
}

}  // namespace myotact::prepare
