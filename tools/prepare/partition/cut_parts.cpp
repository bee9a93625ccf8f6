#include "prepare/partition/cut_parts.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "prepare/parallel.h"
#include "prepare/partition/give_back_volumes.h"
#include "prepare/partition/interfaces.h"
#include "prepare/partition/simplify_interfaces.h"
#include "prepare/partition/smooth_interfaces.h"
#include "prepare/remesh/crossing_triangles.h"

namespace myotact::prepare {

namespace {

/// How much simpler, in steps of the lattice; at a millimetre this is as for limbs that come as surfaces
/// (fine_surface.h).
struct Coarseness {
  double tolerance = 0.0, longest_edge = 0.0;
};
constexpr Coarseness kFine{0.15, 7.0}, kSkin{0.3, 9.0};
/// Small and thin parts stay truer: their tolerance is no more than this part of their thickness, three times their
/// volume through their area (a ball's radius). Else a carpal bone would be left with 70 triangles.
constexpr double kThicknessTolerance = 0.05;
/// Where triangles came to cross, all within this many steps stay as they were cut.
constexpr double kKept = 3.0;
/// Where smoothing would make triangles cross, all within this many steps move less.
constexpr double kUnsmoothed = 1.0;
constexpr int kHalvings = 6;
constexpr int kRounds = 6;
/// Vertices move no farther than this when volumes are given back [steps]: more could bring thin parts' sides together.
constexpr double kMostGiven = 0.1;
/// More crossings of one part than this say no more about where to leave it alone.
constexpr unsigned kMostCrossings = 1000;

/// A place of each pair of triangles that cross, in all parts.
std::vector<Vec3> crossings(const std::vector<geometry::TriangleMesh>& surfaces, int threads) {
  std::vector<std::vector<Vec3>> found_m(surfaces.size());
  for_each_index(surfaces.size(), threads, [&](std::size_t p) {
    for (const auto& [a, b] : crossing_triangles(surfaces[p], kMostCrossings)) {
      for (const int t : {a, b}) {
        for (const int v : surfaces[p].triangles[at(t)]) found_m[p].push_back(surfaces[p].positions_m[at(v)]);
      }
    }
  });
  std::vector<Vec3> all_m;
  for (const auto& places_m : found_m) all_m.insert(all_m.end(), places_m.begin(), places_m.end());
  return all_m;
}

struct Simplified {
  Interfaces interfaces;
  std::vector<geometry::TriangleMesh> surfaces;  // of its parts
};

/// One a part, with volumes as given.
std::vector<double> tolerances_m(const Interfaces& interfaces, double most_m, const std::vector<double>& volumes_m3) {
  const std::vector<double> areas = areas_m2(interfaces, volumes_m3.size());
  std::vector<double> result_m(volumes_m3.size());
  for (std::size_t p = 0; p < result_m.size(); ++p) {
    result_m[p] = std::min(most_m, kThicknessTolerance * 3.0 * volumes_m3[p] / areas[p]);
  }
  return result_m;
}

/// Simplified so far that no part crosses itself.
Simplified simplify_without_crossings(const Interfaces& interfaces, double step_m, const Coarseness& coarseness,
                                      const std::vector<double>& volumes_m3, int threads) {
  const SimplifySettings settings{tolerances_m(interfaces, coarseness.tolerance * step_m, volumes_m3),
                                  coarseness.longest_edge * step_m};
  std::vector<Vec3> kept_m;
  for (int round = 0; round < kRounds; ++round) {
    const NearPlaces kept(kept_m, kKept * step_m);
    Simplified simple{simplify(interfaces, settings, kept, threads), {}};
    give_back_volumes(volumes_m3, kMostGiven * step_m, kept, simple.interfaces);
    simple.surfaces = surfaces_of(simple.interfaces, static_cast<int>(volumes_m3.size()));
    const std::vector<Vec3> found_m = crossings(simple.surfaces, threads);
    if (found_m.empty()) return simple;
    kept_m.insert(kept_m.end(), found_m.begin(), found_m.end());
  }
  throw bad_data("volume", "borders",
                 fmt::format("cross themselves near {:.1f} {:.1f} {:.1f} mm; smooth the segmentation there",
                             1e3 * kept_m.back().x(), 1e3 * kept_m.back().y(), 1e3 * kept_m.back().z()));
}

/// Smoothed as far as no part crosses itself: near where one would, half as far, and again.
Interfaces smooth_without_crossings(const Interfaces& cut, double step_m, std::size_t parts, int threads) {
  const Interfaces smooth = smooth_interfaces(cut);
  std::vector<double> share(cut.positions_m.size(), 1.0);
  Interfaces result = smooth;
  for (int round = 0; round < kHalvings; ++round) {
    const std::vector<Vec3> found_m = crossings(surfaces_of(result, static_cast<int>(parts)), threads);
    if (found_m.empty()) return result;
    const NearPlaces near(found_m, kUnsmoothed * step_m);
    const double factor = round + 1 < kHalvings ? 0.5 : 0.0;
    for (std::size_t v = 0; v < share.size(); ++v) {
      if (near.contain(result.positions_m[v])) share[v] *= factor;
      result.positions_m[v] = cut.positions_m[v] + share[v] * (smooth.positions_m[v] - cut.positions_m[v]);
    }
  }
  return crossings(surfaces_of(result, static_cast<int>(parts)), threads).empty() ? result : cut;
}

}  // namespace

CutParts cut_parts(const PartVolume& volume, int threads) {
  const double length_m = step_m(volume.lattice);
  const Interfaces cut = smooth_without_crossings(cut_interfaces(volume), length_m, volume.keys.size(), threads);
  const std::vector<double> volumes_m3 = enclosed_volumes_m3(cut, volume.keys.size());
  Simplified fine = simplify_without_crossings(cut, length_m, kFine, volumes_m3, threads);
  Simplified skins = simplify_without_crossings(fine.interfaces, length_m, kSkin, volumes_m3, threads);
  return {std::move(fine.surfaces), std::move(skins.surfaces)};
}

}  // namespace myotact::prepare
