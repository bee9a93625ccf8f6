#pragma once

#include "geometry/triangle_mesh.h"
#include "prepare/part/borders.h"

namespace myotact::prepare {

/// A muscle cut along its borders.
struct Cut {
  geometry::TriangleMesh left;  // in one piece
  double dropped_m3 = 0.0;      // enclosed by the other pieces
  double spacing_m = 0.0;       // of the lattice that it was extracted on
  int tunnels = 0;              // that the muscle did not have before
};

/// What is left of a muscle. When its borders would cut it in two, its core stays: `borders.core` is set.
Cut cut_muscle(const Body& own, Borders& borders, double clearance_m);

/// Films that close the tunnels of the cut (film.h), thick enough to be muscle; empty when there are none.
geometry::TriangleMesh film_over_tunnels(const Body& own, const Borders& borders, double clearance_m, const Cut& cut);

/// Closes what tunnels the cut still has with films of one node's thickness, whatever is in their way. Tunnels of a
/// lattice step or two come and go with films; this ends them.
void patch_tunnels(const Body& own, const Borders& borders, double clearance_m, Cut& cut);

}  // namespace myotact::prepare
