#pragma once

#include <functional>

#include <Eigen/Geometry>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// A body as a function of space [m]: negative inside, positive outside. It must not change faster than distance does
/// (|f(p) - f(q)| <= |p - q|), as signed distances, their maxima and halved differences do; whole blocks are passed
/// over by that. Must be callable from the thread that extracts.
using BodyField = std::function<double(const Vec3&)>;

/// The surface f = 0 inside `box`, which it must not leave: closed, manifold, outward, without crossings, whatever the
/// field, because each small tetrahedron of a lattice (six to a cube of `spacing_m`) is cut by at most two triangles.
/// Vertices lie on lattice edges, where the field vanishes to a few hundredths of the spacing. What is thinner than the
/// spacing may be missed.
geometry::TriangleMesh extract_level_set(const BodyField& field, const Eigen::AlignedBox3d& box, double spacing_m);

/// Spacing at which a surface of that area is extracted with about so many triangles (eight to a square of the spacing,
/// measured on spheres).
double spacing_for_triangles_m(double area_m2, double triangles);
/// Spacing at which a body's tendons are seen: a part of its mean thickness 2 V / A.
double spacing_for_thickness_m(double area_m2, double volume_m3);

}  // namespace myotact::prepare
