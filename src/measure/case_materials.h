#pragma once

#include "core/json_reader.h"
#include "measure/solve_case.h"

namespace myotact::measure {

/// The materials of a case; entries of the same region add up. Fills `materials` and `material_of_tet`; checks that
/// every tet has a matrix, and fibres where a law needs them.
void read_materials(const JsonValue& value, SolveCase& out);

/// c of 1/2 c (J - mean J)^2 for a region that names none: the volume term's own stiffness at rest, so that a
/// compressible law stays as it is, but at most four times the shear modulus, so that a nearly incompressible one does
/// not lock (40 kPa for muscle of 10 kPa).
double default_fluctuation_Pa(const std::vector<simulation::Law>& laws);

}  // namespace myotact::measure
