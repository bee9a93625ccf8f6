#pragma once

#include "app/options.h"
#include "measure/stiffness_part.h"

namespace myotact::app {

/// What `myotact stiffness` leaves of a whole sweep: stiffness.csv, stiffness.json, stiffness.svg and stiffness_map.svg
/// in
/// --out, the table on standard output, the reasons at the highest level in the log. Throws Error InputOutput.
/// Returns CheckFailed when a row did not converge.
int answer_sweep(const Options& options, const measure::SweepPart& sweep);

/// The same of one part of several: its file alone, and its table.
int answer_part(const Options& options, const measure::SweepPart& part);

}  // namespace myotact::app
