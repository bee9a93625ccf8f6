#pragma once

#include "simulation/muscle/tissue_pass.h"

namespace myotact::simulation {

/// Adds what the neighbours press on a muscle to its forces, torques and, if the pass wants it, tangent. Stores each
/// touch's slope if the pass wants a tangent (0 where contact is held). The neighbours' nodes are taken as they were
/// seen last: their own slopes are coupled_solve.h's.
void add_neighbour_contact(const TissuePass& pass);

}  // namespace myotact::simulation
