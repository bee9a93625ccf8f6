#pragma once

#include "core/json_reader.h"
#include "measure/solve_case.h"

namespace myotact::measure {

/// The materials of a case; entries of the same region add up. Fills `materials` and `material_of_tet`; checks that
/// every tet has a matrix, and fibres where a law needs them.
void read_materials(const JsonValue& value, SolveCase& out);

}  // namespace myotact::measure
