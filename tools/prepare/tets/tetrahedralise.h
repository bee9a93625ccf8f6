#pragma once

#include <string>

#include "geometry/tet_mesh.h"
#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// Fills a closed surface with tetrahedra by TetGen ("pq1.4/10Y": the surface's triangles are kept as they are). The
/// first nodes are the surface's vertices in their order. Runs in a child process with a time limit, because TetGen
/// ends its process on surfaces that cross themselves. Throws Error BadData naming the surface and the likely cause;
/// Internal when no child can be made. Call from a program with one thread only (it forks).
geometry::TetMesh tetrahedralise(const std::string& name, const geometry::TriangleMesh& surface);

}  // namespace myotact::prepare
