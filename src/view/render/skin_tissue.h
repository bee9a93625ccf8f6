#pragma once

#include <array>
#include <vector>

#include "anatomy/specimen.h"

namespace myotact::view {

/// What lies under each vertex of a muscle's skin, interpolated from the tets' own values.
struct SkinTissue {
  std::vector<Vec3> fibres;    // unit, from origin to insertion
  std::vector<float> tendons;  // share of tendon, 0 .. 1
};

/// From belly to tendon the share never changes by more than 1 over this way [m] along an edge of the skin: about what
/// a belly of the limbs at hand takes to run out into its tendon.
inline constexpr double kTendonBlend_m = 0.020;

/// Without tets or fibres everything is belly, with fibres along the muscle's line (`line`, or null).
SkinTissue skin_tissue(const anatomy::Muscle& muscle, const anatomy::MuscleLine* line);

/// The largest field below `values` that changes by no more than 1 over `way_m` along the edges. One value a vertex.
void limit_slope(const geometry::TriangleMesh& surface, double way_m, std::vector<float>& values);

/// Vertices next to each one, ahead and behind along the fibres; itself where there is none.
std::vector<std::array<int, 2>> neighbours_along(const geometry::TriangleMesh& surface,
                                                 const std::vector<Vec3>& fibres);

}  // namespace myotact::view
