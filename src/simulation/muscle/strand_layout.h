#pragma once

#include <vector>

#include "anatomy/specimen.h"
#include "simulation/muscle/tendon_strand.h"

namespace myotact::simulation {

struct MuscleTissue;

/// Length of the line in the rest position, round its wraps.
double line_length_m(const anatomy::MuscleLine& line);

/// One strand for each end of the muscle that has tendon tets: it starts at the border between belly and tendon and
/// follows the rest of the muscle's line to the bone. The weights of the border nodes are the nodal forces of a unit
/// fibre stress in the belly, so that strand and fibres balance node by node.
/// `skeleton` is moved through the ranges of its joints and left at the file pose. The elements, clamps and free
/// indices of `tissue` must be there.
std::vector<TendonStrand> lay_strands(const anatomy::Muscle& muscle, const anatomy::MuscleLine& line,
                                      const MuscleTissue& tissue, Skeleton& skeleton);

}  // namespace myotact::simulation
