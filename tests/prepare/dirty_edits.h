#pragma once

#include <functional>
#include <random>
#include <vector>

#include "core/at.h"
#include "prepare/dirty_surfaces.h"

// The single changes that dirty surfaces are made of. Lengths and gaps named so are parts of the diagonal.

namespace myotact::testing {

using Make = std::function<geometry::TriangleMesh(const TubeBody&, std::mt19937&)>;

/// A defect that changes the mesh in place.
Make edit(std::function<void(geometry::TriangleMesh&, const TubeBody&, std::mt19937&)> change);

Vec3 random_vector(std::mt19937& random, double length);
double diagonal_of(const geometry::TriangleMesh& mesh);
void flip(geometry::TriangleMesh& mesh, std::size_t triangle);
geometry::TriangleMesh turned(geometry::TriangleMesh mesh);
geometry::TriangleMesh scaled(geometry::TriangleMesh mesh, double factor, const Vec3& shift = Vec3::Zero());
bool has_vertex(const std::array<int, 3>& triangle, int v);

/// Without the triangles around the vertices.
geometry::TriangleMesh without(geometry::TriangleMesh mesh, const std::vector<int>& vertices);
/// Without the triangles whose middle lies within `radius` diagonals of a vertex in the middle ring.
geometry::TriangleMesh with_round_hole(const TubeBody& body, double radius);
/// Every triangle with its own three vertices, each displaced by up to `gap` diagonals.
geometry::TriangleMesh soup_of(const geometry::TriangleMesh& mesh, std::mt19937& random, double gap);
/// Puts a vertex in the middle of one side of a triangle, but not into the neighbour.
void split_one_side(geometry::TriangleMesh& mesh, std::size_t triangle);
/// A disc that closes a ring inside.
void add_wall(geometry::TriangleMesh& mesh, const TubeBody& body, int ring);
/// A flag on the edge from (ring, side) to the next ring, sticking out.
void add_fin(geometry::TriangleMesh& mesh, const TubeBody& body, int ring, int side);
/// Cuts the surface open along a third of a ring and pulls the lips apart by `gap` diagonals.
void add_slit(geometry::TriangleMesh& mesh, const TubeBody& body, int ring, double gap);

}  // namespace myotact::testing
