#pragma once

#include <optional>
#include <string>

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// Throws Error BadData when the surface has a size that no limb has, which is what other units look like.
void check_size(const std::string& name, const geometry::TriangleMesh& mesh);

/// What keeps a surface from being the skin of bodies.
struct SurfaceDefect {
  std::string problem;  // "is open: 3 edges have a triangle on one side only"
  Vec3 place_m = Vec3::Zero();
};

/// The first of: no triangles, unused vertices, triangles without area, edges or vertices that are not manifold,
/// neighbours wound differently, pieces wound inward, crossings. Nothing: closed, manifold, outward, free of crossings.
/// Indices must be in range and coordinates finite.
std::optional<SurfaceDefect> find_defect(const geometry::TriangleMesh& mesh);

}  // namespace myotact::prepare
