#pragma once

#include "core/json_reader.h"
#include "measure/solve_case.h"

namespace myotact::measure {

/// Fills the loads, their growth and the activation.
void read_conditions(const JsonValue& value, const NodeSets& sets, SolveCase& out);

/// Static equilibrium needs every part of the mesh held against all six rigid motions; throws Error BadData naming the
/// part by its first tet and size.
void check_held(const SolveCase& solve_case);

}  // namespace myotact::measure
