#include "measure/validation/report.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::measure {
namespace {

constexpr std::size_t kColumns = 8;
using Row = std::array<std::string, kColumns>;

std::string short_number(double value) {
  return fmt::format("{:.7g}", value);
}

std::string tolerance_text(const Check& check) {
  return check.expectation == Expectation::Value ? fmt::format("{:.2g}", check.tolerance) : "-";
}

std::vector<Row> rows_of(const std::vector<CaseResult>& results) {
  std::vector<Row> rows = {{"case", "quantity", "expected", "obtained", "error", "tolerance", "result", "source"}};
  for (const CaseResult& result : results) {
    for (const CheckResult& c : result.checks) {
      rows.push_back({result.name, c.check.quantity, expected_text(c.check), short_number(c.obtained),
                      fmt::format("{:.2g}", c.error), tolerance_text(c.check), c.passed ? "pass" : "FAIL",
                      c.check.source});
    }
  }
  return rows;
}

const char* expectation_name(Expectation expectation) {
  switch (expectation) {
    case Expectation::Value:
      return "value";
    case Expectation::AtLeast:
      return "at_least";
    case Expectation::AtMost:
      return "at_most";
  }
  return "";
}

}  // namespace

std::string expected_text(const Check& check) {
  switch (check.expectation) {
    case Expectation::Value:
      return to_text(check.expected);
    case Expectation::AtLeast:
      return ">= " + to_text(check.expected);
    case Expectation::AtMost:
      return "<= " + to_text(check.expected);
  }
  return "";
}

std::string validation_table(const std::vector<CaseResult>& results) {
  const std::vector<Row> rows = rows_of(results);
  constexpr std::size_t last = kColumns - 1;  // the source may be long
  std::array<std::size_t, last> widths{};
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < last; ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string table;
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < last; ++c) table += fmt::format("{:<{}}  ", row[c], widths[c]);
    table += row[last] + '\n';
  }
  const auto failed = std::count_if(rows.begin() + 1, rows.end(), [](const Row& row) { return row[6] == "FAIL"; });
  table += fmt::format("{} checks in {} cases, {} failed\n", rows.size() - 1, results.size(), failed);
  return table;
}

std::string validation_json(const std::vector<CaseResult>& results) {
  nlohmann::json cases = nlohmann::json::array();
  bool passed = true;
  for (const CaseResult& result : results) {
    passed = passed && result.passed();
    nlohmann::json checks = nlohmann::json::array();
    for (const CheckResult& c : result.checks) {
      checks.push_back({{"quantity", c.check.quantity},
                        {expectation_name(c.check.expectation), c.check.expected},
                        {"obtained", c.obtained},
                        {"error", c.error},
                        {"tolerance", c.check.tolerance},
                        {"passed", c.passed},
                        {"source", c.check.source}});
    }
    cases.push_back({{"name", result.name}, {"title", result.title}, {"passed", result.passed()}, {"checks", checks}});
  }
  return nlohmann::json{{"schema", 1}, {"passed", passed}, {"cases", cases}}.dump(2) + "\n";
}

}  // namespace myotact::measure
