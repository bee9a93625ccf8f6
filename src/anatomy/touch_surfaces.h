#pragma once

#include <vector>

#include "anatomy/specimen.h"

namespace myotact::anatomy {

/// Everything of a specimen that can be touched, in the order in which contacts number surfaces: the muscles' skins,
/// then the bones. They belong to the specimen.
std::vector<const geometry::TriangleMesh*> touch_surfaces(const Specimen& specimen);

}  // namespace myotact::anatomy
