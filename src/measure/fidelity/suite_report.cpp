#include "measure/fidelity/suite_report.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace myotact::measure {

namespace {

bool all_met(const MeasuredGoal& measured) {
  return std::all_of(measured.result.figures.begin(), measured.result.figures.end(),
                     [](const Figure& figure) { return figure.met(); });
}

}  // namespace

bool MeasuredGoal::passed() const {
  return std::all_of(result.figures.begin(), result.figures.end(),
                     [](const Figure& figure) { return figure.timing || figure.met(); });
}

MeasuredGoal measure_goal(const Goal& goal, Effort effort) {
  const auto start = std::chrono::steady_clock::now();
  MeasuredGoal measured{goal, goal.measure(effort), 0.0};
  measured.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return measured;
}

std::string goal_text(const MeasuredGoal& measured) {
  const char* verdict = measured.result.figures.empty() ? "not measured" : all_met(measured) ? "met" : "MISSED";
  std::string text = fmt::format("{:>2}  {:<62} {}\n", measured.goal.number, measured.goal.title, verdict);
  for (const Figure& figure : measured.result.figures) {
    text += fmt::format("      {:<58} {:>11.4g} {:<6} goal {} {:<9.4g} {}{}\n", figure.what, figure.value, figure.unit,
                        figure.at_least ? ">=" : "<=", figure.goal, figure.met() ? "met" : "MISSED",
                        figure.timing ? " (timing)" : "");
  }
  if (!measured.result.note.empty()) text += fmt::format("      {}\n", measured.result.note);
  return text;
}

std::string suite_json(std::span<const MeasuredGoal> goals) {
  nlohmann::json list = nlohmann::json::array();
  bool passed = true;
  for (const MeasuredGoal& measured : goals) {
    nlohmann::json figures = nlohmann::json::array();
    for (const Figure& figure : measured.result.figures) {
      figures.push_back({{"what", figure.what},
                         {"value", figure.value},
                         {"unit", figure.unit},
                         {"goal", figure.goal},
                         {"at_least", figure.at_least},
                         {"timing", figure.timing},
                         {"met", figure.met()}});
    }
    passed = passed && measured.passed();
    list.push_back({{"number", measured.goal.number},
                    {"title", measured.goal.title},
                    {"measured", !figures.empty()},
                    {"met", !figures.empty() && all_met(measured)},
                    {"wall_s", measured.wall_s},
                    {"figures", figures},
                    {"note", measured.result.note}});
  }
  return nlohmann::json{{"passed", passed}, {"goals", list}}.dump(2) + "\n";
}

}  // namespace myotact::measure
