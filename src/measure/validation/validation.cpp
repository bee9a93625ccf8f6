#include "measure/validation/validation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/text.h"

namespace myotact::measure {
namespace {

constexpr double kLargestTolerance = 1e300;  // any finite one that can still be multiplied

using MaybeValue = std::optional<JsonValue>;

/// `relative` or `absolute`, which a value has and nothing else.
void read_tolerance(const JsonValue& place, JsonObject& object, Check& check) {
  const MaybeValue relative = object.find("relative");
  const MaybeValue absolute = object.find("absolute");
  const int wanted = check.expectation == Expectation::Value ? 1 : 0;
  if (relative.has_value() + absolute.has_value() != wanted) {
    throw place.error("a value comes with exactly one tolerance, relative or absolute; anything else with none");
  }
  if (absolute) check.tolerance = absolute->number_between(0.0, kLargestTolerance);
  if (!relative) return;
  check.tolerance = relative->number_between(0.0, 1.0) * std::abs(check.expected);
  if (check.expected == 0.0) throw relative->error("means nothing for the value 0; give an absolute tolerance");
}

/// `value`, `at_least`, `at_most` or `reported`.
void read_expectation(const JsonValue& place, JsonObject& object, Check& check) {
  const MaybeValue value = object.find("value");
  const MaybeValue at_least = object.find("at_least");
  const MaybeValue at_most = object.find("at_most");
  const MaybeValue reported = object.find("reported");
  if (value.has_value() + at_least.has_value() + at_most.has_value() + reported.has_value() != 1) {
    throw place.error("expects exactly one of value, at_least, at_most and reported");
  }
  if (reported) {
    check.expectation = Expectation::Reported;
    if (!reported->boolean()) throw reported->error("is false; must be true, or a value or bound in its place");
    return;
  }
  check.expected = (value ? *value : at_least ? *at_least : *at_most).number();
  check.expectation = value ? Expectation::Value : at_least ? Expectation::AtLeast : Expectation::AtMost;
}

Check read_check(const JsonValue& place, const std::string& source) {
  JsonObject object(place);
  Check check;
  check.quantity = object.at("quantity").string();
  check.source = object.string_or("source", source);
  read_expectation(place, object, check);
  read_tolerance(place, object, check);
  object.finish();
  return check;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const Kind& kind : validation_kinds()) names.push_back(kind.name);
  return names;
}

const Kind& read_kind(JsonObject& object) {
  const std::string name = object.at("kind").one_of(kind_names());
  const auto& kinds = validation_kinds();
  return *std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.name == name; });
}

/// Everything but the keys of the kind.
ValidationCase read_case(JsonObject& object) {
  object.at("schema").integer_between(1, 1);
  read_kind(object);
  ValidationCase result;
  result.file = object.value().file();
  result.name = std::filesystem::path(result.file).stem().string();
  result.title = object.at("title").string();
  result.source = object.at("source").string();
  result.slow = object.boolean_or("slow", false);
  const JsonValue checks = object.at("checks");
  for (const JsonValue& check : checks.elements()) result.checks.push_back(read_check(check, result.source));
  const auto is_checked = [](const Check& check) { return check.expectation != Expectation::Reported; };
  if (std::none_of(result.checks.begin(), result.checks.end(), is_checked)) {
    throw checks.error("holds no value and no bound; a case that checks nothing proves nothing");
  }
  return result;
}

double obtained_of(const Quantities& quantities, const Check& check, const JsonValue& place) {
  const auto found = quantities.find(check.quantity);
  if (found != quantities.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, value] : quantities) known.push_back(name);
  throw JsonObject(place)
      .at("quantity")
      .error(fmt::format("\"{}\" is not computed by this case (nearest: \"{}\")", check.quantity,
                         nearest_word(check.quantity, known)));
}

}  // namespace

bool CaseResult::passed() const {
  return std::none_of(checks.begin(), checks.end(),
                      [](const CheckResult& result) { return result.verdict == Verdict::Fail; });
}

std::filesystem::path validation_folder() {
  const auto folder = data_folder() / "tests" / "validation";
  std::error_code ignored;
  if (std::filesystem::is_directory(folder, ignored)) return folder;
  throw Error(ExitStatus::NoInput, folder.string() +
                                       ": is not there; the cases come with the source tree, name it in the variable "
                                       "MYOTACT_DATA_DIR");
}

std::vector<ValidationCase> load_cases(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") paths.push_back(entry.path());
  }
  if (paths.empty()) throw Error(ExitStatus::NoInput, folder.string() + ": holds no case file NAME.json");
  std::sort(paths.begin(), paths.end());
  std::vector<ValidationCase> cases;
  for (const auto& path : paths) {
    nlohmann::json json = read_json(path);
    JsonObject object(JsonValue(json, path.string()));
    cases.push_back(read_case(object));
    cases.back().json = std::move(json);
  }
  return cases;
}

std::vector<ValidationCase> select_cases(const std::vector<ValidationCase>& cases, const std::string& filter) {
  std::vector<ValidationCase> selected;
  std::vector<std::string> names;
  for (const ValidationCase& candidate : cases) {
    names.push_back(candidate.name);
    if (candidate.name == filter) return {candidate};
    if (candidate.name.find(filter) != std::string::npos) selected.push_back(candidate);
  }
  if (!selected.empty()) return selected;
  throw Error(ExitStatus::Usage, fmt::format("--filter {}: no case has this in its name (nearest: \"{}\")", filter,
                                             nearest_word(filter, names)));
}

CheckResult compare(const Check& check, double obtained) {
  CheckResult result{check, obtained, 0.0, Verdict::Fail};
  switch (check.expectation) {
    case Expectation::Value:
      result.error = std::abs(obtained - check.expected);
      break;
    case Expectation::AtLeast:
      result.error = obtained >= check.expected ? 0.0 : check.expected - obtained;
      break;
    case Expectation::AtMost:
      result.error = obtained <= check.expected ? 0.0 : obtained - check.expected;
      break;
    case Expectation::Reported:
      if (std::isfinite(obtained)) result.verdict = Verdict::Reported;
      return result;
  }
  if (result.error <= check.tolerance) result.verdict = Verdict::Pass;  // false for NaN
  return result;
}

CaseResult run_case(const ValidationCase& validation_case) {
  JsonObject object(JsonValue(validation_case.json, validation_case.file));
  read_case(object);  // asks for the common keys once more, so that finish() knows them
  const Quantities quantities = read_kind(object).run(object);
  object.finish();
  CaseResult result{validation_case.name, validation_case.title, validation_case.source, {}};
  const auto places = object.at("checks").elements();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Check& check = validation_case.checks[i];
    result.checks.push_back(compare(check, obtained_of(quantities, check, places[i])));
  }
  return result;
}

}  // namespace myotact::measure
