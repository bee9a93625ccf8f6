#pragma once

#include "core/json_reader.h"

namespace myotact::measure {

/// How many steps of dt_s a time takes. Throws Error BadData unless it is a whole number of steps, 1 .. 10 million.
int step_count(const JsonValue& time_s, double dt_s);

}  // namespace myotact::measure
