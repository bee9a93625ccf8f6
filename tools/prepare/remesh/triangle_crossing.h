#pragma once

#include <array>

#include "core/vector.h"

namespace myotact::prepare {

using Corners = std::array<Vec3, 3>;

/// Sign of the volume of the tet a b c d, exact: +1 when d lies on the side from which a b c runs clockwise (as
/// det(b-a, c-a, d-a) > 0), 0 when the four lie in one plane.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Whether two triangles without a common corner have a point in common. Exact but for triangles in one plane, which
/// are compared by their projection in rounded arithmetic.
bool triangles_meet(const Corners& a, const Corners& b);

/// Whether the closed segment pq meets the triangle. As above.
bool segment_meets(const Vec3& p, const Vec3& q, const Corners& triangle);

}  // namespace myotact::prepare
