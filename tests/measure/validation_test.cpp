#include "measure/validation/validation.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::measure {
namespace {

using myotact::testing::complaint;
using myotact::testing::TemporaryFolder;
using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string check(const std::string& quantity, const std::string& rest) {
  return "{\"quantity\": \"" + quantity + "\"" + rest + "}";
}

/// A case of the kind isotonic_velocity, whose answers for Thelen's curve are those of Hill's hyperbola: 0.375, 1/6.
std::string hill_case(const std::string& checks, const std::string& more = "") {
  return R"({"schema": 1, "kind": "isotonic_velocity", "title": "t", "source": "the case's",
             "curve_set": "thelen_2003", "loads": [0.25, 0.5], )" +
         more + R"("checks": [)" + checks + "]}";
}

const std::string kQuarter = "shortening(0.25)";
const std::string kHalf = "shortening(0.5)";
const std::string kBound = check(kHalf, R"(, "at_least": 0)");

class ValidationCases : public ::testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) { write_file(folder_.path() / (name + ".json"), text); }
  std::vector<ValidationCase> load() { return load_cases(folder_.path()); }
  CaseResult run(const std::string& checks) {
    put("only", hill_case(checks));
    return run_case(load().at(0));
  }
  std::string refusal(const std::string& text) {
    put("only", text);
    return complaint(ExitStatus::BadData, [&] { run_case(load().at(0)); });
  }

  TemporaryFolder folder_;
};

TEST_F(ValidationCases, CompareValuesAndBounds) {
  const CaseResult result =
      run(check(kQuarter, R"(, "value": 0.3751, "relative": 1e-3)") + "," +
          check(kQuarter, R"(, "value": 0.376, "absolute": 1e-4, "source": "its own")") + "," +
          check(kHalf, R"(, "at_least": 0.16)") + "," + check(kHalf, R"(, "at_least": 0.17)") + "," +
          check(kHalf, R"(, "at_most": 0.17)") + "," + check(kHalf, R"(, "at_most": 0.16)"));
  std::vector<bool> passed;
  for (const CheckResult& outcome : result.checks) passed.push_back(outcome.verdict == Verdict::Pass);
  EXPECT_EQ(passed, (std::vector<bool>{true, false, true, false, true, false}));
  EXPECT_FALSE(result.passed());
  EXPECT_EQ(result.name, "only");
  EXPECT_EQ(result.checks[0].check.source, "the case's");
  EXPECT_EQ(result.checks[1].check.source, "its own");
  EXPECT_NEAR(result.checks[0].check.tolerance, 3.751e-4, 1e-15);
  EXPECT_NEAR(result.checks[0].error, 1e-4, 1e-12);
  EXPECT_NEAR(result.checks[1].error, 1e-3, 1e-12);
  EXPECT_EQ(result.checks[2].error, 0.0);
  EXPECT_NEAR(result.checks[3].error, 0.17 - 1.0 / 6.0, 1e-12);
}

Verdict verdict(Expectation expectation, double expected, double tolerance, double obtained) {
  return compare({"q", expectation, expected, tolerance, ""}, obtained).verdict;
}

TEST_F(ValidationCases, NanAndInfinityFail) {
  for (const Expectation expectation :
       {Expectation::Value, Expectation::AtLeast, Expectation::AtMost, Expectation::Reported}) {
    EXPECT_EQ(verdict(expectation, 1.0, 1e300, kNaN), Verdict::Fail);
  }
  EXPECT_EQ(verdict(Expectation::Value, 1.0, 1e300, kInfinity), Verdict::Fail);
  EXPECT_EQ(verdict(Expectation::AtMost, 1.0, 0.0, kInfinity), Verdict::Fail);
  EXPECT_EQ(verdict(Expectation::Reported, 0.0, 0.0, kInfinity), Verdict::Fail);
  EXPECT_EQ(verdict(Expectation::Reported, 0.0, 0.0, -kInfinity), Verdict::Fail);
}

TEST_F(ValidationCases, AnErrorOfExactlyTheTolerancePasses) {
  EXPECT_EQ(verdict(Expectation::Value, 1.0, 0.5, 1.5), Verdict::Pass);
  EXPECT_EQ(verdict(Expectation::AtMost, 0.0, 0.0, 0.0), Verdict::Pass);
}

TEST_F(ValidationCases, WhatIsReportedIsNotJudged) {
  const std::string reported = check(kQuarter, R"(, "reported": true, "source": "for comparison")");
  const CaseResult result = run(reported + "," + kBound);
  EXPECT_EQ(result.checks[0].verdict, Verdict::Reported);
  EXPECT_NEAR(result.checks[0].obtained, 0.375, 1e-9);
  EXPECT_EQ(result.checks[0].check.source, "for comparison");
  EXPECT_EQ(result.checks[1].verdict, Verdict::Pass);
  EXPECT_TRUE(result.passed());
  EXPECT_FALSE(run(reported + "," + check(kHalf, R"(, "at_least": 1)")).passed());
  EXPECT_THAT(refusal(hill_case(reported)), HasSubstr("/checks: holds no value and no bound"));
  EXPECT_THAT(refusal(hill_case(kBound + "," + check(kHalf, R"(, "reported": false)"))),
              HasSubstr("/checks/1/reported: is false; must be true"));
}

TEST_F(ValidationCases, AreReadInOrderOfTheirNames) {
  put("b", hill_case(kBound));
  put("a", hill_case(kBound, R"("slow": true, )"));
  write_file(folder_.path() / "notes.txt", "not a case");
  const auto cases = load();
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].name, "a");
  EXPECT_TRUE(cases[0].slow);
  EXPECT_FALSE(cases[1].slow);
  EXPECT_TRUE(run_case(cases[0]).passed());
}

TEST_F(ValidationCases, AnEmptyFolderIsNoInput) {
  EXPECT_THAT(complaint(ExitStatus::NoInput, [&] { load(); }), HasSubstr("no case file"));
}

TEST_F(ValidationCases, FilterTakesTheWholeNameFirst) {
  std::vector<ValidationCase> cases(3);
  cases[0].name = "pendulum";
  cases[1].name = "pendulum_small";
  cases[2].name = "order";
  EXPECT_EQ(select_cases(cases, "pendulum").size(), 1u);
  EXPECT_EQ(select_cases(cases, "pendulum_").size(), 1u);
  EXPECT_EQ(select_cases(cases, "p").size(), 2u);
  EXPECT_EQ(select_cases(cases, "").size(), 3u);
  EXPECT_THAT(complaint(ExitStatus::Usage, [&] { select_cases(cases, "ordre"); }), HasSubstr("nearest: \"order\""));
}

TEST_F(ValidationCases, RefusalsNamePlaceAndNearest) {
  EXPECT_THAT(refusal(hill_case(kBound, R"("kond": 1, )")), HasSubstr("/kond: unknown key; the nearest"));
  EXPECT_THAT(refusal(hill_case(check("shortning(0.5)", R"(, "at_least": 0)"))),
              HasSubstr("/checks/0/quantity: \"shortning(0.5)\" is not computed by this case (nearest: "
                        "\"shortening(0.5)\")"));
  EXPECT_THAT(refusal(R"({"schema": 1, "kind": "pendulum", "title": "", "source": "", "checks": []})"),
              HasSubstr("nearest: \"hinge_pendulum\""));
  EXPECT_THAT(refusal(R"({"schema": 2})"), HasSubstr("/schema"));
  EXPECT_THAT(refusal(hill_case("")), HasSubstr("/checks: holds no value and no bound"));
  EXPECT_THAT(refusal(hill_case(check(kHalf, R"(, "at_least": 0, "sauce": "")"))),
              HasSubstr("/checks/0/sauce: unknown key; the nearest known one is \"source\""));
}

TEST_F(ValidationCases, ACheckHasExactlyOneExpectation) {
  for (const char* wrong :
       {"", R"(, "value": 1)", R"(, "value": 1, "relative": 0.1, "absolute": 0.1)", R"(, "at_least": 1, "at_most": 2)",
        R"(, "value": 1, "relative": 0.1, "at_most": 2)", R"(, "at_most": 2, "absolute": 0.1)",
        R"(, "at_most": 2, "absolute": 0.1, "relative": 0.1)", R"(, "value": 0, "relative": 0.1)",
        R"(, "reported": true, "at_most": 2)", R"(, "reported": true, "absolute": 1)", R"(, "reported": 1)",
        R"(, "value": 1, "relative": 2)", R"(, "value": 1, "absolute": -1)", R"(, "value": "1", "absolute": 1)"}) {
    EXPECT_THAT(refusal(hill_case(check(kHalf, wrong))), HasSubstr("only.json: /checks/0")) << wrong;
  }
}

}  // namespace
}  // namespace myotact::measure
