#pragma once

#include <span>
#include <string>

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// A goal with what was measured.
struct MeasuredGoal {
  Goal goal;
  GoalFigures result;
  double wall_s = 0.0;

  /// Whether all figures that do not depend on the machine meet the goal. What cannot be measured yet fails nothing.
  bool passed() const;
};

MeasuredGoal measure_goal(const Goal& goal, Effort effort);

/// One goal: its line of title and verdict, one line a figure, the note. Ends with a newline.
std::string goal_text(const MeasuredGoal& measured);
/// All goals as JSON: {"passed", "goals": [{number, title, measured, met, wall_s, figures: [...], note}]}.
std::string suite_json(std::span<const MeasuredGoal> goals);

}  // namespace myotact::measure
