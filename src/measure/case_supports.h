#pragma once

#include "measure/solve_case.h"

namespace myotact::measure {

/// Refuses a static case some of whose tets can move without being deformed: a part that its supports do not hold
/// against all six rigid motions, or a block that hangs on others by a node or an edge and can swing there.
void check_supports(const SolveCase& solve_case);

}  // namespace myotact::measure
