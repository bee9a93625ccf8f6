#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry/triangle_mesh.h"

// What CGAL does for the repair. Every input must have been checked: closed and manifold where that is said, because
// CGAL in a release build trusts its callers. Whatever CGAL throws comes back as "no result".

namespace myotact::prepare {

/// Triangles of least area over a closed loop, as indices into it, wound along it. Empty: none was found.
std::vector<std::array<int, 3>> span_loop(const std::vector<Vec3>& loop);

/// Refines some triangles of a closed manifold surface to the density of those around them, and lets the vertices added
/// there continue the surface smoothly. All other vertices and triangles stay.
std::optional<geometry::TriangleMesh> blend_triangles(const geometry::TriangleMesh& mesh,
                                                      const std::vector<bool>& marked);

/// The surface around both bodies. Each input closed, manifold, outward and free of crossings.
std::optional<geometry::TriangleMesh> unite(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b);

/// Takes out triangles that cross each other and smooths or refills there; the number of holes through the body stays.
/// Closed manifold input. The result may still cross itself: check it.
std::optional<geometry::TriangleMesh> untangle(const geometry::TriangleMesh& mesh);

/// Which points lie inside a closed surface, or on it.
std::vector<bool> points_inside(const geometry::TriangleMesh& mesh, const std::vector<Vec3>& points);

}  // namespace myotact::prepare
