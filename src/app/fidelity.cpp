#include <iostream>
#include <vector>

#include <spdlog/spdlog.h>

#include "app/options.h"
#include "core/error.h"
#include "measure/fidelity/suite_report.h"

namespace myotact::app {

int fidelity(const Options& options) {
  if (!options.suite && options.goals.empty()) {
    throw Error(ExitStatus::Usage, "fidelity: say what to measure: --suite for every goal, or --goal 6,8 for some");
  }
  const auto effort = options.brief ? measure::Effort::Short : measure::Effort::Full;
  std::vector<measure::MeasuredGoal> measured;
  bool passed = true;
  for (const measure::Goal& goal : measure::select_goals(options.goals)) {
    spdlog::info("goal {}: {}", goal.number, goal.title);
    measured.push_back(measure::measure_goal(goal, effort));
    passed = passed && measured.back().passed();
    if (!options.json) std::cout << measure::goal_text(measured.back()) << std::flush;
  }
  if (options.json) std::cout << measure::suite_json(measured) << std::flush;
  return static_cast<int>(passed ? ExitStatus::Done : ExitStatus::CheckFailed);
}

}  // namespace myotact::app
