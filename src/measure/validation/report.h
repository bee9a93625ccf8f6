#pragma once

#include <string>
#include <vector>

#include "measure/validation/validation.h"

namespace myotact::measure {

/// One line a check: case, quantity, expected, obtained, error, tolerance, pass or FAIL, source; then the count.
std::string validation_table(const std::vector<CaseResult>& results);

/// {schema, passed, cases: [{name, title, passed, checks: [...]}]}; a number that is not finite becomes null.
std::string validation_json(const std::vector<CaseResult>& results);

/// A page that needs nothing but itself: the table, and for every case the errors as parts of their tolerances.
std::string validation_html(const std::vector<CaseResult>& results);

/// "0.5", ">= 2", "<= 1e-12".
std::string expected_text(const Check& check);

}  // namespace myotact::measure
