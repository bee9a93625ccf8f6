#pragma once

#include "core/json_reader.h"
#include "measure/solve_case.h"

namespace myotact::measure {

/// Fills the loads, their growth and the activation.
void read_conditions(const JsonValue& value, const NodeSets& sets, SolveCase& out);

}  // namespace myotact::measure
