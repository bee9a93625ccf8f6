#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace myotact::measure {

/// How long a goal is measured: `Short` is for tests (seconds), `Full` is what the goal asks for (up to minutes).
enum class Effort { Short, Full };

/// One measured number beside what it should be.
struct Figure {
  std::string what;  // e.g. "1000 N/m on tissue of 300 N/m, felt stiffness"
  double value = 0.0;
  std::string unit;
  double goal = 0.0;
  bool at_least = false;  // else `value` should be at most `goal`
  bool timing = false;    // depends on the machine and its load: reported, never counted as a failure

  bool met() const { return at_least ? value >= goal : value <= goal; }  // a NaN meets nothing
};

struct GoalFigures {
  std::vector<Figure> figures;  // empty: it cannot be measured yet, the note states why
  std::string note;             // under which conditions; where a figure misses its goal, why
};

/// One numbered goal of how true and safe the rendering is.
struct Goal {
  int number = 0;
  std::string_view title;
  GoalFigures (*measure)(Effort effort) = nullptr;  // deterministic but for timing figures; throws Error
};

/// All goals that can be measured, by number.
std::span<const Goal> fidelity_goals();

/// Those with these numbers; all for an empty list. Throws Error Usage for a number that is not there.
std::vector<Goal> select_goals(std::span<const int> numbers);

}  // namespace myotact::measure
