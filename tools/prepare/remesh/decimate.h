#pragma once

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

struct DecimateSettings {
  double edge_m = 0.0;       // no edge grows beyond 4/3 of this
  double tolerance_m = 0.0;  // how far the result may lie from the surface, both ways
  double least_shape = 0.3;  // of the triangles made (1: equilateral), where the former were not worse
};

/// Fewer triangles on the same surface: edges are collapsed, those first that matter least to the shape (quadric
/// error, Garland and Heckbert 1997), as long as the result stays closed, free of crossings and within the tolerance.
/// Then triangles are evened by flips and by moves along the surface, and the enclosed volume is given back. Closed
/// manifold input without crossings.
geometry::TriangleMesh decimate(const geometry::TriangleMesh& surface, const DecimateSettings& settings);

/// Even triangles of edges near `edge_m` about a surface that may be thinner than they are long: the shortest edges are
/// collapsed first, and the enclosed volume is kept. Else as above.
geometry::TriangleMesh coarsen(const geometry::TriangleMesh& surface, const DecimateSettings& settings);

}  // namespace myotact::prepare
