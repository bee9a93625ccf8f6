#pragma once

#include <vector>

#include "geometry/triangle_mesh.h"
#include "prepare/part/borders.h"

namespace myotact::prepare {

/// A muscle cut along its borders.
struct Cut {
  geometry::TriangleMesh left;   // the largest piece
  double dropped_m3 = 0.0;       // enclosed by the other pieces
  std::vector<Vec3> loose_ends;  // farthest places of dropped pieces that reach far beyond what is left: tendons
  double spacing_m = 0.0;        // of the lattice that it was extracted on
  int added_genus = 0;           // that the muscle did not have before

  bool needs_film() const { return added_genus > 0 || !loose_ends.empty(); }
};

/// What is left of a muscle.
Cut cut_muscle(const Body& own, const Borders& borders, double clearance_m);

/// Whether more was dropped than scraps.
bool falls_apart(const Body& own, const Cut& cut);

/// When the borders cut the muscle in two, its core stays: `borders.core` is set, and it is cut again.
void keep_core(const Body& own, Borders& borders, double clearance_m, Cut& cut);

/// Films that close the handles of the cut and strands to its loose ends (film.h), thick enough to be muscle.
geometry::TriangleMesh film_surface(const Body& own, const Borders& borders, double clearance_m, const Cut& cut);

/// Closes what handles the cut still has, and holds its loose ends, with films of one node's thickness, whatever is in
/// their way. Handles of a lattice step or two come and go with films; this ends them. Returns the films' surface;
/// empty when nothing was done.
geometry::TriangleMesh patch(const Body& own, const Borders& borders, double clearance_m, Cut& cut);

}  // namespace myotact::prepare
