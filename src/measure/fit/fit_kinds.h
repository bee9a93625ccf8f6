#pragma once

#include "core/json_reader.h"
#include "measure/fit/fit_problem.h"
#include "measure/fit/measured_table.h"

namespace myotact::measure {

/// What a kind of measurement needs. To add one: a function each for `model`, `setting` and `predict`, a line in the
/// table of fit_kinds.cpp, a paragraph in assets/cases/README.md.
struct FitKind {
  const char* name;
  MeasuredQuantity x, y;
  /// The model with everything that a parameter may stand for, checked. `folder`: that relative paths start at.
  nlohmann::json (*model)(const JsonValue& value, const std::filesystem::path& folder);
  /// What the fit's file says of a curve besides its file and sigma, checked against the model; may change x.
  nlohmann::json (*setting)(JsonObject& fields, const nlohmann::json& model, FitCurve& curve);
  /// Fills `predict` of a problem that has all else.
  void (*predict)(FitProblem& problem);
};

/// Throws Error BadData naming the nearest one.
const FitKind& fit_kind(const JsonValue& name);

/// The file that a model's name means, else the value itself: an object in place. The second is the file for messages.
std::pair<nlohmann::json, std::string> model_or_file(const JsonValue& value, const std::filesystem::path& folder);

FitKind passive_length_tension_kind();
FitKind joint_torque_kind();
FitKind indentation_kind();

}  // namespace myotact::measure
