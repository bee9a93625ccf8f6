#pragma once

#include <optional>

#include "app/options.h"
#include "app/progress.h"
#include "device/profile_file.h"
#include "measure/fidelity/device_run.h"

namespace myotact::app {

/// The profile that --device names, or none. Throws Error: Usage for two, NoInput for an unknown one.
std::optional<device::NamedProfile> named_profile(const Options& options);

/// Shows the work's progress, which outlives it, and stops it at SIGINT and SIGTERM.
measure::RunWatch watch_until_interrupted(Progress& progress);

}  // namespace myotact::app
