#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "measure/fit/fit_problem.h"
#include "measure/fit/fit_statistics.h"

namespace myotact::measure {

struct FitAnswer {
  LeastSquaresFit fit;
  FitStatistics statistics;
  std::vector<double> fitted;         // curve by curve, as predict() gives them
  double residual_rms = 0.0;          // of fitted less measured, in the unit of the curves
  double r_squared = 0.0;             // share of the measured values' variance that is explained
  std::vector<std::string> warnings;  // what must not be quoted of it, a sentence each
};

/// Fits a problem. `progress` is called before every evaluation of the model, and what it throws ends the fit.
FitAnswer fit(const FitProblem& problem, const std::function<void()>& progress = {});

/// Parameters with units and intervals, quality, correlation, warnings and the fitted model (assets/cases/README.md).
/// What is not known is null.
nlohmann::ordered_json fit_json(const FitProblem& problem, const FitAnswer& answer);

/// One row a point: file, x, measured, fitted, residual (fitted less measured).
std::string fit_csv(const FitProblem& problem, const FitAnswer& answer);

/// A table for a person: parameters with intervals, then the warnings.
std::string fit_text(const FitProblem& problem, const FitAnswer& answer);

}  // namespace myotact::measure
