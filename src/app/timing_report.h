#pragma once

#include <iosfwd>

#include <nlohmann/json_fwd.hpp>

#include "scene/free_session.h"

namespace myotact::app {

/// Rates, percentiles and what the system did not permit. A tick is that of all tools, one after the other; of several,
/// each has its own beside it.
nlohmann::json timing_json(const scene::FreeTiming& timing, const scene::Scene& scene);

/// The summary of a run for a reader: one figure a line.
void print_summary(const nlohmann::json& report, std::ostream& out);

}  // namespace myotact::app
