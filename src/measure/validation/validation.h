#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "measure/validation/kinds.h"

namespace myotact::measure {

// Cases that compare what the program computes with closed forms and published figures. A case is a file NAME.json of
// tests/validation/, whose README gives the format.

/// Reported: a figure that is shown and not checked, for comparison with those that are.
enum class Expectation { Value, AtLeast, AtMost, Reported };
enum class Verdict { Pass, Fail, Reported };

struct Check {
  std::string quantity;
  Expectation expectation = Expectation::Value;
  double expected = 0.0;
  double tolerance = 0.0;  // largest absolute error; 0 for all but Value
  std::string source;      // the case's own, if the check has none
};

/// A case file, understood but for the keys of its kind.
struct ValidationCase {
  std::string name, title, source;
  bool slow = false;
  std::vector<Check> checks;
  std::string file;
  nlohmann::json json;  // of the whole file
};

struct CheckResult {
  Check check;
  double obtained = 0.0;
  double error = 0.0;  // how far off; for AtLeast and AtMost how far on the wrong side, else 0
  Verdict verdict = Verdict::Fail;
};

struct CaseResult {
  std::string name, title, source;
  std::vector<CheckResult> checks;
  bool passed() const;  // nothing failed
};

/// tests/validation of the data folder. Throws Error NoInput naming the remedy.
std::filesystem::path validation_folder();

/// All cases of a folder, by name. Throws Error NoInput when there is none, BadData naming file and pointer.
std::vector<ValidationCase> load_cases(const std::filesystem::path& folder);

/// The case of that name or else all whose names hold `filter`. Throws Error Usage naming the nearest when none does.
std::vector<ValidationCase> select_cases(const std::vector<ValidationCase>& cases, const std::string& filter);

/// Runs the kind on the file's inputs and compares. Throws Error BadData for an input that the kind refuses and for a
/// check of a quantity that it does not compute.
CaseResult run_case(const ValidationCase& validation_case);

/// NaN always fails, and of what is only reported infinity does too.
CheckResult compare(const Check& check, double obtained);

}  // namespace myotact::measure
