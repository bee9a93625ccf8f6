#pragma once

#include <vector>

#include "simulation/muscle/muscle_tissue.h"

namespace myotact::simulation {

/// The springs of all elements of a muscle on a linear mesh whose pattern is made, eight tets a batch, in the order of
/// the elements.
std::vector<SpringBatch> lay_springs(const MuscleTissue& tissue);

}  // namespace myotact::simulation
