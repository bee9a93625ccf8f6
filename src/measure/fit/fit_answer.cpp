#include "measure/fit/fit_answer.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/at.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/text.h"

namespace myotact::measure {

namespace {

std::vector<BoundedParameter> ranges_of(const FitProblem& problem) {
  std::vector<BoundedParameter> ranges;
  for (const FitParameter& parameter : problem.parameters) ranges.push_back(parameter.range);
  return ranges;
}

/// Fitted less measured, over sigma.
Eigen::VectorXd weighted_residuals(const FitProblem& problem, const std::vector<double>& fitted) {
  Eigen::VectorXd residuals(static_cast<Eigen::Index>(fitted.size()));
  Eigen::Index i = 0;
  for (const FitCurve& curve : problem.curves) {
    for (const double y : curve.y) {
      residuals[i] = (fitted[static_cast<std::size_t>(i)] - y) / curve.sigma;
      ++i;
    }
  }
  return residuals;
}

void measure_quality(const FitProblem& problem, FitAnswer& answer) {
  double squares = 0.0, sum = 0.0;
  for (const FitCurve& curve : problem.curves) {
    for (const double y : curve.y) sum += y;
  }
  const double mean = sum / static_cast<double>(problem.points());
  double about_mean = 0.0;
  std::size_t i = 0;
  for (const FitCurve& curve : problem.curves) {
    for (const double y : curve.y) {
      squares += (answer.fitted[i] - y) * (answer.fitted[i] - y);
      about_mean += (y - mean) * (y - mean);
      ++i;
    }
  }
  answer.residual_rms = std::sqrt(squares / static_cast<double>(problem.points()));
  answer.r_squared = about_mean > 0.0 ? 1.0 - squares / about_mean : std::nan("");
}

/// "peak_force_N by +10 % and passive_strain by +3.1 %".
std::string direction_text(const FitProblem& problem, const FitBlindDirection& direction) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < direction.parameters.size(); ++k) {
    const FitParameter& parameter = problem.parameters[at(direction.parameters[k])];
    const std::string size = parameter.range.logarithmic()
                                 ? fmt::format("{:+.2g} %", 10.0 * direction.change[k])
                                 : fmt::format("{:+.2g} {}", 0.1 * direction.change[k], parameter.unit);
    parts.push_back(fmt::format("{} by {}", parameter.name, size));
  }
  return join(parts, " and ");
}

void warn_of_bounds(const FitProblem& problem, FitAnswer& answer) {
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    const int bound = answer.fit.bound[j];
    if (bound == 0) continue;
    answer.warnings.push_back(
        fmt::format("{} sits at its {} bound, {}, and has no interval: widen its bounds if it may lie beyond",
                    problem.parameters[j].name, bound < 0 ? "lower" : "upper", to_text(answer.fit.values[j])));
  }
}

/// Intervals within which the curves say next to nothing.
void warn_of_wide(const FitProblem& problem, FitAnswer& answer) {
  const Eigen::MatrixXd& correlation = answer.statistics.correlation;
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    const FitInterval& interval = answer.statistics.of[j];
    const BoundedParameter& range = problem.parameters[j].range;
    const double wide = range.logarithmic() ? std::log(2.0) : 0.5 * (range.high - range.low);
    if (!interval.known || interval.half_width < wide) continue;
    std::string partner;
    double strongest = 0.9;
    for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
      const double r = correlation(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i));
      if (i == j || std::abs(r) < strongest) continue;
      strongest = std::abs(r);
      partner = fmt::format(": it is mixed up with {} (correlation {:.3f}); hold one of the two",
                            problem.parameters[i].name, r);
    }
    answer.warnings.push_back(fmt::format("{} is hardly known from these curves, {} to {}{}",
                                          problem.parameters[j].name, to_text(interval.low), to_text(interval.high),
                                          partner));
  }
}

void add_warnings(const FitProblem& problem, FitAnswer& answer) {
  if (!answer.fit.converged) {
    answer.warnings.push_back(
        "the search did not end: what is given is the best so far; start nearer, or narrow the bounds");
  }
  warn_of_bounds(problem, answer);
  for (const FitBlindDirection& direction : answer.statistics.blind) {
    answer.warnings.push_back(
        fmt::format("only a combination is known: the curves stay as they are when one changes {} together; hold one "
                    "of them, or measure what tells them apart",
                    direction_text(problem, direction)));
  }
  if (!(answer.r_squared > 0.0)) {
    answer.warnings.push_back(
        fmt::format("R2 is {:.3g}: the model is no nearer to the measured values than their mean is; look at sign and "
                    "unit of the columns, and whether the values differ at all",
                    answer.r_squared));
  }
  if (answer.statistics.spare_points <= 0) {
    answer.warnings.emplace_back("there are as many parameters as points, so that no interval can be given");
  }
  warn_of_wide(problem, answer);
}

nlohmann::ordered_json parameter_json(const FitProblem& problem, const FitAnswer& answer, std::size_t j) {
  const FitParameter& parameter = problem.parameters[j];
  const FitInterval& interval = answer.statistics.of[j];
  const int bound = answer.fit.bound[j];
  nlohmann::ordered_json json;
  json["name"] = parameter.name;
  json["unit"] = parameter.unit;
  json["value"] = answer.fit.values[j];
  json["low_95"] = interval.known ? nlohmann::ordered_json(interval.low) : nullptr;
  json["high_95"] = interval.known ? nlohmann::ordered_json(interval.high) : nullptr;
  json["at_bound"] = bound == 0 ? nlohmann::ordered_json(nullptr) : bound < 0 ? "low" : "high";
  json["start"] = parameter.range.start;
  json["low"] = parameter.range.low;
  json["high"] = parameter.range.high;
  return json;
}

nlohmann::ordered_json correlation_json(const FitProblem& problem, const FitAnswer& answer) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
      const bool known = answer.statistics.of[i].known && answer.statistics.of[j].known;
      const double r = answer.statistics.correlation(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i));
      row.push_back(known ? nlohmann::ordered_json(r) : nlohmann::ordered_json(nullptr));
    }
    rows.push_back(row);
  }
  return rows;
}

bool has_sigmas(const FitProblem& problem) {
  return problem.curves.front().has_sigma;
}

}  // namespace

FitAnswer fit(const FitProblem& problem, const std::function<void()>& progress) {
  const auto residuals = [&](const std::vector<double>& values) -> Eigen::VectorXd {
    if (progress) progress();
    try {
      return weighted_residuals(problem, problem.predict(model_with(problem, values)));
    } catch (const Error&) {
      return {};  // values that the model's reader refuses
    }
  };
  FitAnswer answer;
  answer.fit = fit_least_squares(ranges_of(problem), residuals);
  answer.statistics = fit_statistics(ranges_of(problem), answer.fit, problem.blind_share);
  answer.fitted = problem.predict(model_with(problem, answer.fit.values));
  measure_quality(problem, answer);
  add_warnings(problem, answer);
  return answer;
}

nlohmann::ordered_json fit_json(const FitProblem& problem, const FitAnswer& answer) {
  nlohmann::ordered_json json;
  json["title"] = problem.title;
  json["kind"] = problem.kind;
  json["converged"] = answer.fit.converged;
  json["iterations"] = answer.fit.iterations;
  json["evaluations"] = answer.fit.evaluations;
  json["points"] = problem.points();
  json["degrees_of_freedom"] = answer.statistics.spare_points;
  json["residual_rms"] = answer.residual_rms;
  json["unit"] = problem.curves.front().y_name;
  json["R2"] = std::isfinite(answer.r_squared) ? nlohmann::ordered_json(answer.r_squared) : nullptr;
  json["reduced_chi2"] = has_sigmas(problem) ? nlohmann::ordered_json(answer.statistics.variance) : nullptr;
  json["parameters"] = nlohmann::ordered_json::array();
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    json["parameters"].push_back(parameter_json(problem, answer, j));
  }
  json["correlation"] = correlation_json(problem, answer);
  json["warnings"] = answer.warnings;
  json["model"] = model_with(problem, answer.fit.values);
  return json;
}

std::string fit_csv(const FitProblem& problem, const FitAnswer& answer) {
  const FitCurve& first = problem.curves.front();
  std::string csv = fmt::format("file,{},{},fitted,residual\n", first.x_name, first.y_name);
  std::size_t i = 0;
  for (const FitCurve& curve : problem.curves) {
    const std::string file = csv_field(std::filesystem::path(curve.file).filename().string());
    for (std::size_t k = 0; k < curve.y.size(); ++k, ++i) {
      csv += fmt::format("{},{},{},{},{}\n", file, to_text(curve.x[k]), to_text(curve.y[k]), to_text(answer.fitted[i]),
                         to_text(answer.fitted[i] - curve.y[k]));
    }
  }
  return csv;
}

std::string fit_text(const FitProblem& problem, const FitAnswer& answer) {
  std::string text = fmt::format("{:<36} {:>12} {:>12} {:>12}  {}\n", "parameter", "value", "95 % from", "to", "unit");
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    const FitInterval& interval = answer.statistics.of[j];
    const auto end = [&](double value) { return interval.known ? fmt::format("{:.5g}", value) : std::string("-"); };
    text += fmt::format("{:<36} {:>12.5g} {:>12} {:>12}  {}\n", problem.parameters[j].name, answer.fit.values[j],
                        end(interval.low), end(interval.high), problem.parameters[j].unit);
  }
  text += fmt::format("{} points, residual {:.3g} (rms, {}), R2 {:.5f}, {} iterations\n", problem.points(),
                      answer.residual_rms, problem.curves.front().y_name, answer.r_squared, answer.fit.iterations);
  return text;
}

}  // namespace myotact::measure
