#pragma once

#include "core/vector.h"
#include "messages/local_model.h"

namespace myotact::layer {

/// What a sphere meets of the surfaces in a model: of each the point that is deepest in it, where it touches; the
/// deepest first. For an engine that has no collision detection of its own. A middle inside of a surface has come
/// through its nearest face. `middle_m` finite; `around` holds the triangles about it.
messages::ReportedContacts contacts_in_model(const messages::LocalModel& around, const Vec3& middle_m, double radius_m);

}  // namespace myotact::layer
