#pragma once

#include <vector>

#include "core/json_reader.h"
#include "core/vector.h"
#include "prepare/loft/rings.h"

namespace myotact::prepare {

/// An ellipse in space: centre and the symmetric matrix a^2 m m^T + b^2 n n^T of its half-axes. The matrix does not
/// care which axis is called the major one, so that neighbouring sections can be interpolated.
struct Ellipse {
  Vec3 centre_m = Vec3::Zero();
  Mat3 shape_m2 = Mat3::Zero();
};

/// Reads {centre_m, major, minor, a_m, b_m}.
Ellipse read_ellipse(const JsonValue& value);

/// Smooth closed surface along the ellipses, with about `spacing_m` between rings and `around` points a ring.
geometry::TriangleMesh loft_ellipses(const std::vector<Ellipse>& ellipses, const Vec3& first_tip, const Vec3& last_tip,
                                     double spacing_m, int around);

}  // namespace myotact::prepare
