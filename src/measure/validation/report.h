#pragma once

#include <string>
#include <vector>

#include "measure/validation/validation.h"

namespace myotact::measure {

/// One line a check: case, quantity, expected, obtained, error, tolerance, result, the source's beginning; then the
/// counts.
std::string validation_table(const std::vector<CaseResult>& results);

/// {schema, passed, cases: [{name, title, passed, checks: [...]}]}; a number that is not finite becomes null, and so
/// does `passed` of a figure that is only reported.
std::string validation_json(const std::vector<CaseResult>& results);

/// A page that needs nothing but itself: the table, and for every case the errors as parts of their tolerances.
std::string validation_html(const std::vector<CaseResult>& results);

/// "0.5", ">= 2", "<= 1e-12", or "-" where nothing is expected.
std::string expected_text(const Check& check);
/// "pass", "FAIL", "reported".
const char* verdict_text(Verdict verdict);
/// Error and tolerance in two digits, or "-" where there is none.
std::string error_text(const CheckResult& result);
std::string tolerance_text(const Check& check);

/// How many checks of all cases ended so.
std::ptrdiff_t count_of(Verdict verdict, const std::vector<CaseResult>& results);

}  // namespace myotact::measure
