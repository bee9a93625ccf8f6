#pragma once

#include <vector>

#include "prepare/partition/interfaces.h"
#include "prepare/partition/near_places.h"

namespace myotact::prepare {

struct SimplifySettings {
  /// Root mean square distance of a vertex from the triangles it stands for, one a part; where parts meet, the least of
  /// theirs.
  std::vector<double> tolerances_m;
  double longest_edge_m = 0.0;  // no edge grows beyond this
};

/// Fewer triangles on the same interfaces: edges are collapsed, those first that matter least to the shape (quadric
/// error, Garland and Heckbert 1997), once for all parts, so that neighbours go on sharing their triangles. Lines where
/// three parts meet collapse along themselves only, places where four meet stay (Dey and others 1999: the link
/// condition in each). No part changes its topology. Vertices near the places of `kept` stay as they are. Slabs are
/// simplified apart, then their seams; the result does not depend on the number of threads.
Interfaces simplify(const Interfaces& interfaces, const SimplifySettings& settings, const NearPlaces& kept,
                    int threads);

}  // namespace myotact::prepare
