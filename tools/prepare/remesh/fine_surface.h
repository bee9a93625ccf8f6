#pragma once

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// A surface that is fine enough for all that follows and no finer: within 0.15 mm of the given one (small bodies: 0.15
/// % of the diagonal), of some thousand triangles. Small ones pass through as they are; very large ones are resampled
/// first, because taking their triangles off one by one would last minutes. Closed, no crossings.
geometry::TriangleMesh fine_surface(const geometry::TriangleMesh& surface);

/// The surface that is touched and drawn, of larger triangles where the body is smooth, within 0.25 mm (0.25 % of
/// the diagonal).
geometry::TriangleMesh skin_surface(const geometry::TriangleMesh& fine);

}  // namespace myotact::prepare
