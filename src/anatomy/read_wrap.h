#pragma once

#include "anatomy/specimen.h"
#include "core/json_reader.h"

namespace myotact::anatomy {

/// The shape of a wrapping surface as specimens and recipes write it: shape, centre_m, side, and axis, radius_m,
/// radii_m or axes by the shape. Body and place on the line are not read. Throws Error BadData naming file and JSON
/// pointer.
LineWrap read_wrap_shape(JsonObject& fields);

/// z is the axis, the other two any across it: the axes of a cylinder.
Mat3 axes_about(const Vec3& axis);

}  // namespace myotact::anatomy
