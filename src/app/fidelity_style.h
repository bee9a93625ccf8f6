#pragma once

#include <string>

#include <fmt/format.h>

#include "measure/fidelity/scene_fidelity.h"

namespace myotact::app {

/// How the pages of `myotact fidelity` begin.
inline constexpr const char* kFidelityHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Myotact: fidelity</title><style>
body { font: 14px sans-serif; color: #222222; margin: 2em; max-width: 70em; }
table { border-collapse: collapse; margin: 0.5em 0; }
th, td { border-bottom: 1px solid #dddddd; padding: 3px 10px; text-align: left; vertical-align: top; }
th.number, td.number { text-align: right; font-variant-numeric: tabular-nums; }
p.why, td.source { color: #555555; font-size: 12px; }
.good { color: #00593f; font-weight: bold; }
.fair { color: #7a5200; font-weight: bold; }
.poor { color: #a02c00; font-weight: bold; }
svg { max-width: 100%; height: auto; }
</style></head><body>
)";

/// A verdict in its colour.
inline std::string graded(measure::Grade grade) {
  return fmt::format(R"(<span class="{0}">{0}</span>)", measure::grade_text(grade));
}

}  // namespace myotact::app
