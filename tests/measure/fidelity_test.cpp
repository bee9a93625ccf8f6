// Every goal of the suite in its short form. Figures of time are printed and judge nothing.

#include <array>
#include <cstdio>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "measure/fidelity/suite_report.h"

namespace myotact::measure {
namespace {

std::set<std::string> misses_of(const MeasuredGoal& measured) {
  std::set<std::string> misses;
  for (const Figure& figure : measured.result.figures) {
    if (!figure.met() && !figure.timing) misses.insert(figure.what);
  }
  return misses;
}

class EveryGoal : public ::testing::TestWithParam<Goal> {};

TEST_P(EveryGoal, IsMetButForTime) {
  const MeasuredGoal measured = measure_goal(GetParam(), Effort::Short);
  std::printf("%s", goal_text(measured).c_str());
  EXPECT_EQ(measured.result.figures.empty(), measured.result.note.starts_with("not measured: "));
  EXPECT_EQ(misses_of(measured), std::set<std::string>());
}

INSTANTIATE_TEST_SUITE_P(Fidelity, EveryGoal, ::testing::ValuesIn(fidelity_goals().begin(), fidelity_goals().end()),
                         [](const auto& goal) { return "Goal" + std::to_string(goal.param.number); });

GoalFigures one_missed(Effort) {
  return {{{"met", 1.0, "N", 2.0}, {"missed", 1.0, "N", 2.0, true}, {"slow", 9.0, "us", 2.0, false, true}}, "why"};
}

TEST(FidelityReport, SaysWhatIsMissedAndByHowMuch) {
  const MeasuredGoal measured = measure_goal({99, "a goal", one_missed}, Effort::Short);
  EXPECT_FALSE(measured.passed());
  const nlohmann::json json = nlohmann::json::parse(suite_json(std::array{measured}));
  EXPECT_FALSE(json["passed"]);
  EXPECT_TRUE(json["goals"][0]["figures"][0]["met"]);
  EXPECT_FALSE(json["goals"][0]["figures"][1]["met"]);
  EXPECT_NE(goal_text(measured).find("why"), std::string::npos);
}

TEST(FidelityReport, TimeAloneFailsNothing) {
  MeasuredGoal measured = measure_goal({99, "a goal", one_missed}, Effort::Short);
  measured.result.figures.erase(measured.result.figures.begin() + 1);
  EXPECT_TRUE(measured.passed());
}

TEST(FidelityReport, NotANumberMeetsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((Figure{"x", nan, "", 1.0}.met()));
  EXPECT_FALSE((Figure{"x", nan, "", 1.0, true}.met()));
}

TEST(FidelityGoals, AnUnknownNumberIsRefusedWithTheKnownOnes) {
  try {
    select_goals(std::array{4711});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::Usage);
    EXPECT_NE(std::string(error.what()).find("5"), std::string::npos);
  }
}

}  // namespace
}  // namespace myotact::measure
