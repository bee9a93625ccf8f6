#pragma once

#include <string>

#include "geometry/tet_mesh.h"
#include "geometry/triangle_mesh.h"
#include "prepare/tets/tet_quality.h"

namespace myotact::prepare {

/// The coarse mesh that a muscle is simulated with, around its fine surface.
struct Cage {
  geometry::TriangleMesh surface;  // closed, no crossings
  geometry::TetMesh tets;          // the first nodes are the surface's vertices
  TetQuality quality;
  double edge_m = 0.0;  // that was aimed at
  int attempts = 0;
  double volume_error = 0.0;  // relative to the fine surface's
  double deviation_m = 0.0;   // largest distance between cage and fine surface, both ways
};

/// Fills a fine surface (closed, no crossings) with about `tets` tetrahedra. The cage's surface stays within half an
/// edge of the fine one and encloses the same volume. Several edge lengths are tried; the first good one, or else the
/// best, is taken. When none can be filled, the surface is made anew where its winding number is a half, and that is
/// caged. Throws Error BadData naming the muscle when that fails, too.
Cage make_cage(const std::string& name, const geometry::TriangleMesh& fine, double tets);

/// Edge length at which a body of this volume holds about `tets` tetrahedra: that of `tets` regular ones,
/// h = (6 sqrt2 V / tets)^(1/3).
double edge_for_tets_m(double volume_m3, double tets);

}  // namespace myotact::prepare
