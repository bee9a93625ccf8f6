#pragma once

#include <string>

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// What was done to a surface before it could enclose a volume.
struct SurfaceRepair {
  int welded_vertices = 0;    // joined because their coordinates were equal
  int dropped_triangles = 0;  // without area, or a second copy of another one
  int turned_triangles = 0;   // wound against their neighbours or inward
  int dropped_pieces = 0;     // loose pieces below a hundredth of the area
};

/// Welds equal corners, drops triangles without area, turns all triangles outward, drops loose specks. Throws Error
/// BadData naming the surface, the count and a place when it is empty, has a coordinate that is not finite, is not
/// closed, has edges with more than two triangles, or has a size that no limb has.
geometry::TriangleMesh clean_surface(const std::string& name, const geometry::TriangleMesh& raw,
                                     SurfaceRepair* repair = nullptr);

/// Throws Error BadData naming the first crossing when triangles of the surface cross each other.
void refuse_crossings(const std::string& name, const geometry::TriangleMesh& mesh);

}  // namespace myotact::prepare
