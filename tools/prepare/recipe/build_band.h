#pragma once

#include "geometry/triangle_mesh.h"
#include "prepare/recipe/anatomy_data.h"

namespace myotact::prepare {

/// A flat band with elliptical sections from end to end. Its width lies across the x-z plane, in which limbs flex.
geometry::TriangleMesh build_band(const BandData& band);

}  // namespace myotact::prepare
