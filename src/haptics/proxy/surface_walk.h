#pragma once

#include "core/vector.h"
#include "haptics/proxy/moving_surface.h"
#include "haptics/proxy/near_surface.h"

namespace myotact::haptics {

/// Walks from a triangle over its neighbours (those that share a corner) as long as that comes nearer to `p_m`, at the
/// beginning of the tick. It ends on the sheet where it began: other sheets, though nearer, are not neighbours.
/// Real-time safe; a step looks at every triangle.
NearestPoint walk_to_nearest(const MovingSurface& surface, int start, const Vec3& p_m) noexcept;

/// Outward direction at a point of the surface, at the beginning of the tick: the normals of all triangles there,
/// weighted by their angles (Baerentzen and Aanaes 2005). Zero at the border of what is known: it has no inside.
Vec3 outward_at(const MovingSurface& surface, const NearestPoint& place) noexcept;

}  // namespace myotact::haptics
