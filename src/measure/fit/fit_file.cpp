#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/json_places.h"
#include "core/text.h"
#include "measure/fit/fit_kinds.h"

namespace myotact::measure {

namespace {

constexpr std::size_t kMostFitCurves = 50, kMostFitParameters = 20;
constexpr double kFarthestBound = 1e15;

/// By the ending of the last word: "peak_force_N" is in N.
std::string unit_of_key(const std::string& key) {
  static const std::vector<std::pair<std::string, std::string>> endings = {
      {"_Nm_rad", "N m/rad"}, {"_rad", "rad"}, {"_Pa", "Pa"}, {"_Nm", "N m"}, {"_N", "N"}, {"_m", "m"}, {"_s", "s"}};
  for (const auto& [ending, unit] : endings) {
    if (key.ends_with(ending)) return unit;
  }
  return "1";
}

FitCurve read_curve(const JsonValue& value, const FitKind& kind, const nlohmann::json& model,
                    const std::filesystem::path& folder) {
  JsonObject fields(value);
  FitCurve curve;
  const std::filesystem::path file = folder / fields.at("file").string();
  const std::vector<MeasuredQuantity> wanted = {kind.x, kind.y};
  auto columns = read_measured_table(file, wanted);
  curve.file = file.string();
  curve.x_name = columns[0].column;
  curve.y_name = kind.y.columns.front().name;
  curve.x = std::move(columns[0].si);
  curve.y = std::move(columns[1].si);
  if (const auto sigma = fields.find("sigma")) {
    curve.sigma = sigma->number_between(1e-15, 1e15);
    curve.has_sigma = true;
  }
  curve.setting = kind.setting(fields, model, curve);
  fields.finish();
  return curve;
}

void require_number_places(const JsonValue& value, const std::string& key, const FitProblem& problem) {
  nlohmann::json model = problem.model;
  const auto places = places_of(key, model);
  if (places.empty()) {
    std::vector<std::string> known;
    const nlohmann::json flat = problem.model.flatten();
    for (const auto& [pointer, number] : flat.items()) {
      if (!number.is_number()) continue;
      std::string dotted = pointer.substr(1);
      std::replace(dotted.begin(), dotted.end(), '/', '.');
      known.push_back(dotted);
    }
    throw value.error(
        fmt::format("\"{}\" is nothing in the model; the nearest is \"{}\"", key, nearest_word(key, known)));
  }
  const bool all_numbers =
      std::all_of(places.begin(), places.end(), [](const auto* place) { return place->is_number(); });
  if (!all_numbers) throw value.error(fmt::format("\"{}\" is no number in the model; name one that is", key));
}

BoundedParameter read_bounds(JsonObject& fields) {
  BoundedParameter range;
  const JsonValue start = fields.at("start"), low = fields.at("low"), high = fields.at("high");
  range.low = low.number_between(-kFarthestBound, kFarthestBound);
  range.high = high.number_between(-kFarthestBound, kFarthestBound);
  range.start = start.number();
  if (!(range.low < range.high)) {
    throw high.error(fmt::format("is {}, not above low, {}; exchange them", to_text(range.high), to_text(range.low)));
  }
  if (!(range.start > range.low && range.start < range.high)) {
    throw start.error(fmt::format("is {}; must lie between low, {}, and high, {}, and on neither", to_text(range.start),
                                  to_text(range.low), to_text(range.high)));
  }
  return range;
}

FitParameter read_parameter(const JsonValue& value, const FitProblem& problem) {
  JsonObject fields(value);
  FitParameter parameter;
  const JsonValue name = fields.at("name");
  parameter.name = name.string();
  const auto keys = fields.find("keys");
  parameter.keys = keys ? keys->strings() : std::vector<std::string>{parameter.name};
  if (parameter.keys.empty()) throw keys->error("is empty; name what of the model it stands for, or leave it out");
  for (const std::string& key : parameter.keys) require_number_places(keys ? *keys : name, key, problem);
  parameter.relative = fields.boolean_or("relative", false);
  parameter.range = read_bounds(fields);
  parameter.unit = parameter.relative ? "1" : unit_of_key(parameter.keys.front());
  fields.finish();
  return parameter;
}

void read_parameters(const JsonValue& list, FitProblem& problem) {
  std::set<std::string> names;
  for (const JsonValue& element : list.elements()) {
    problem.parameters.push_back(read_parameter(element, problem));
    if (!names.insert(problem.parameters.back().name).second) {
      throw element.error(fmt::format("\"{}\" is there twice; leave one out", problem.parameters.back().name));
    }
  }
  if (problem.parameters.empty() || problem.parameters.size() > kMostFitParameters) {
    throw list.error(fmt::format("has {} entries; must have 1 to {}", problem.parameters.size(), kMostFitParameters));
  }
  if (problem.points() < problem.parameters.size()) {
    throw list.error(fmt::format("has {} parameters, but the curves have {} points in all; measure more, or free fewer",
                                 problem.parameters.size(), problem.points()));
  }
}

void read_curves(const JsonValue& list, const FitKind& kind, const std::filesystem::path& folder, FitProblem& problem) {
  std::size_t with_sigma = 0;
  for (const JsonValue& element : list.elements()) {
    problem.curves.push_back(read_curve(element, kind, problem.model, folder));
    with_sigma += problem.curves.back().has_sigma ? 1U : 0U;
    if (problem.curves.size() > kMostFitCurves) throw list.error(fmt::format("has more than {} files", kMostFitCurves));
  }
  if (problem.curves.empty()) throw list.error("is empty; name at least one file of measured values");
  if (with_sigma != 0 && with_sigma != problem.curves.size()) {
    throw list.error("has sigma for some files only; give it for all, or for none");
  }
}

std::vector<double> starts_of(const FitProblem& problem) {
  std::vector<double> starts;
  for (const FitParameter& parameter : problem.parameters) starts.push_back(parameter.range.start);
  return starts;
}

/// The start must be possible, and each parameter must change something when it goes a tenth of its way to a bound.
void check_start(const JsonValue& list, const FitProblem& problem) {
  constexpr double kWay = 0.1, kNothing = 1e-9;
  std::vector<double> values = starts_of(problem);
  std::vector<double> at_start;
  try {
    at_start = problem.predict(model_with(problem, values));
  } catch (const Error& error) {
    throw list.error(fmt::format("cannot be computed at the start values: {}", error.what()));
  }
  double largest = 0.0;
  for (const FitCurve& curve : problem.curves) {
    for (const double y : curve.y) largest = std::max(largest, std::abs(y));
  }
  for (std::size_t j = 0; j < values.size(); ++j) {
    const BoundedParameter& range = problem.parameters[j].range;
    double change = 0.0;
    bool possible = false;
    for (const double bound : {range.low, range.high}) {
      std::vector<double> moved = values;
      moved[j] += kWay * (bound - moved[j]);
      try {
        const std::vector<double> after = problem.predict(model_with(problem, moved));
        possible = true;
        for (std::size_t i = 0; i < after.size(); ++i) change = std::max(change, std::abs(after[i] - at_start[i]));
      } catch (const Error&) {
        continue;  // the search turns back there, too
      }
    }
    if (possible && change > kNothing * largest) continue;
    throw list.error(
        fmt::format("{} changes nothing of these curves about its start; leave it out, or measure where it acts",
                    problem.parameters[j].name));
  }
}

}  // namespace

std::size_t FitProblem::points() const {
  std::size_t count = 0;
  for (const FitCurve& curve : curves) count += curve.y.size();
  return count;
}

FitProblem load_fit(const std::filesystem::path& path) {
  const nlohmann::json json = read_json(path);
  JsonObject fields(JsonValue(json, path.string()));
  fields.at("schema").integer_between(1, 1);
  FitProblem problem;
  problem.file = path.string();
  const FitKind& kind = fit_kind(fields.at("kind"));
  problem.kind = kind.name;
  problem.title = fields.string_or("title", path.stem().string());
  const std::filesystem::path folder = path.parent_path();
  const JsonValue model = fields.at("model"), measurements = fields.at("measurements"),
                  parameters = fields.at("parameters");
  fields.finish();
  problem.model = kind.model(model, folder);
  read_curves(measurements, kind, folder, problem);
  read_parameters(parameters, problem);
  kind.predict(problem);
  check_start(parameters, problem);
  return problem;
}

nlohmann::json model_with(const FitProblem& problem, const std::vector<double>& values) {
  nlohmann::json model = problem.model;
  for (std::size_t j = 0; j < values.size(); ++j) {
    for (const std::string& key : problem.parameters[j].keys) {
      for (nlohmann::json* place : places_of(key, model)) {
        *place = problem.parameters[j].relative ? place->get<double>() * values[j] : values[j];
      }
    }
  }
  return model;
}

}  // namespace myotact::measure
