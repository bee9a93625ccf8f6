#pragma once

#include <string>

namespace myotact {

/// Sets up the log on standard error ("trace" .. "critical", "off"). Never call a log function from a haptic tick.
/// Throws Error Usage for an unknown level.
void start_log(const std::string& level);

}  // namespace myotact
