#pragma once

#include <string>

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// Throws Error BadData when the triangles around some vertex do not form one fan, so that no half-edge structure can
/// hold the surface (two bodies that touch in a point, a pinched scan).
void check_half_edges(const std::string& name, const geometry::TriangleMesh& mesh);

/// Moves vertices along the surface only, towards the middle of their neighbours, to even the triangles. Closed mesh.
void relax_along_surface(geometry::TriangleMesh& mesh, int passes);

}  // namespace myotact::prepare
