#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "measure/fit/least_squares_fit.h"

// A fit as `myotact fit` reads it: assets/cases/README.md, Fits, documents the file.

namespace myotact::measure {

/// A measured curve.
struct FitCurve {
  std::string file;            // for messages and tables
  std::string x_name, y_name;  // quantities in SI: "depth_m", "force_N"
  std::vector<double> x, y;
  double sigma = 1.0;  // standard deviation of y; 1 where the file gives none: all count alike
  bool has_sigma = false;
  nlohmann::json setting;  // what else the fit's file says of it
};

/// A free parameter: numbers of the model's JSON that it stands for.
struct FitParameter {
  std::string name;
  std::vector<std::string> keys;  // places_of() in the model
  bool relative = false;          // it multiplies what the model has there, else it is put there
  BoundedParameter range;
  std::string unit;
};

struct FitProblem {
  std::string title, kind;
  std::string file;      // for messages
  nlohmann::json model;  // with all numbers that parameters may stand for
  std::vector<FitCurve> curves;
  std::vector<FitParameter> parameters;
  /// The curves' fitted values, one after the other, of such a model. Throws Error for one that cannot be.
  std::function<std::vector<double>(const nlohmann::json& model)> predict;
  double blind_share = 1e-6;  // fit_statistics(): above what predict() errs by

  std::size_t points() const;
};

/// Reads and checks a fit and its curves. Throws Error: NoInput, or BadData naming file, place, value, allowed range
/// and remedy; also for a model that cannot be computed at the start, and a parameter that changes nothing.
FitProblem load_fit(const std::filesystem::path& path);

/// The model with such values of the parameters.
nlohmann::json model_with(const FitProblem& problem, const std::vector<double>& values);

}  // namespace myotact::measure
