#pragma once

#include "anatomy/specimen.h"

namespace myotact::prepare {

/// The same limb of the other side: everything mirrored at y = 0. Flexion stays a right-hand rotation.
anatomy::Specimen mirrored(anatomy::Specimen specimen);

}  // namespace myotact::prepare
