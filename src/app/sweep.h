#pragma once

#include <string>

#include "app/options.h"

namespace myotact::app {

/// What only a sweep is asked.
struct SweepWish {
  std::string shard;   // "2/8"; empty: all points
  bool merge = false;  // only join what the shards left
  bool plan = false;   // only count, and measure what a point costs
};

/// myotact sweep SWEEP.json: a file a point in --out, and sweep.csv when all are there.
int sweep(const Options& options, const SweepWish& wish);

}  // namespace myotact::app
