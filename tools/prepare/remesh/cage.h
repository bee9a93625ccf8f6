#pragma once

#include <string>

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// Edge length at which a body of this volume holds about `tets` tetrahedra: that of `tets` regular ones,
/// h = (6 sqrt2 V / tets)^(1/3).
double edge_for_tets_m(double volume_m3, double tets);

/// An even surface that encloses the same volume as `surface`, without crossings.
struct EvenSurface {
  geometry::TriangleMesh mesh;
  double edge_m = 0.0;        // that was aimed at in the end
  int attempts = 1;           // 2 and more: a coarser one crossed itself
  double volume_error = 0.0;  // relative to the surface's
};

/// Remeshes towards `edge_m`, gives back the volume lost at the curved parts by an offset along the normals, and
/// checks. A result that crosses itself is made again with a shorter edge. Throws Error BadData naming the surface when
/// no attempt succeeds.
EvenSurface even_surface(const std::string& name, const geometry::TriangleMesh& surface, double edge_m);

}  // namespace myotact::prepare
