#pragma once

#include "app/options.h"

namespace myotact::app {

/// myotact fit FIT.json: fit.json, fit.csv and fit.svg in --out.
int fit(const Options& options);

}  // namespace myotact::app
