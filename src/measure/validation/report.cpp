#include "measure/validation/report.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.h"

namespace myotact::measure {
namespace {

constexpr std::size_t kColumns = 8;
using Row = std::array<std::string, kColumns>;

std::string short_number(double value) {
  return fmt::format("{:.7g}", value);
}

/// The beginning of a source, so that a line of the table stays one; the page and the JSON have the whole.
std::string short_source(const std::string& source) {
  constexpr std::size_t kLongest = 60;  // bytes
  if (source.size() <= kLongest) return source;
  const std::size_t blank = source.rfind(' ', kLongest);
  return source.substr(0, blank == std::string::npos ? 0 : blank) + " ...";
}

std::vector<Row> rows_of(const std::vector<CaseResult>& results) {
  std::vector<Row> rows = {{"case", "quantity", "expected", "obtained", "error", "tolerance", "result", "source"}};
  for (const CaseResult& result : results) {
    for (const CheckResult& c : result.checks) {
      rows.push_back({result.name, c.check.quantity, expected_text(c.check), short_number(c.obtained), error_text(c),
                      tolerance_text(c.check), verdict_text(c.verdict), short_source(c.check.source)});
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
    case Expectation::Reported:
      return "reported";
  }
  return "";
}

nlohmann::json json_of(const CheckResult& result) {
  const Check& check = result.check;
  nlohmann::json json = {
      {"quantity", check.quantity}, {"obtained", result.obtained}, {"passed", nullptr}, {"source", check.source}};
  if (result.verdict != Verdict::Reported) json["passed"] = result.verdict == Verdict::Pass;
  if (check.expectation == Expectation::Reported) {
    json["reported"] = true;
    return json;
  }
  json[expectation_name(check.expectation)] = check.expected;
  json["error"] = result.error;
  json["tolerance"] = check.tolerance;
  return json;
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
    case Expectation::Reported:
      return "-";
  }
  return "";
}

const char* verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::Pass:
      return "pass";
    case Verdict::Fail:
      return "FAIL";
    case Verdict::Reported:
      return "reported";
  }
  return "";
}

std::string error_text(const CheckResult& result) {
  return result.check.expectation == Expectation::Reported ? "-" : fmt::format("{:.2g}", result.error);
}

std::string tolerance_text(const Check& check) {
  return check.expectation == Expectation::Value ? fmt::format("{:.2g}", check.tolerance) : "-";
}

std::ptrdiff_t count_of(Verdict verdict, const std::vector<CaseResult>& results) {
  std::ptrdiff_t count = 0;
  for (const CaseResult& result : results) {
    count += std::count_if(result.checks.begin(), result.checks.end(),
                           [&](const CheckResult& check) { return check.verdict == verdict; });
  }
  return count;
}

std::string validation_table(const std::vector<CaseResult>& results) {
  const std::vector<Row> rows = rows_of(results);
  constexpr std::size_t last = kColumns - 1;
  std::array<std::size_t, last> widths{};
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < last; ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string table;
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < last; ++c) table += fmt::format("{:<{}}  ", row[c], widths[c]);
    table += row[last] + '\n';
  }
  const auto failed = count_of(Verdict::Fail, results);
  table += fmt::format("{} checks in {} cases, {} failed", count_of(Verdict::Pass, results) + failed, results.size(),
                       failed);
  if (const auto reported = count_of(Verdict::Reported, results); reported > 0) {
    table += fmt::format("; {} reported only", reported);
  }
  table += '\n';
  return table;
}

std::string validation_json(const std::vector<CaseResult>& results) {
  nlohmann::json cases = nlohmann::json::array();
  bool passed = true;
  for (const CaseResult& result : results) {
    passed = passed && result.passed();
    nlohmann::json checks = nlohmann::json::array();
    for (const CheckResult& check : result.checks) checks.push_back(json_of(check));
    cases.push_back({{"name", result.name}, {"title", result.title}, {"passed", result.passed()}, {"checks", checks}});
  }
  return nlohmann::json{{"schema", 1}, {"passed", passed}, {"cases", cases}}.dump(2) + "\n";
}

}  // namespace myotact::measure
