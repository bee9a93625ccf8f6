// Parameters planted into curves with noise of 2 % are found again, and 95 % intervals hold them in 95 % of the cases.

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/file.h"
#include "measure/fit/fit_answer.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::measure {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using testing::complaint;
using ::testing::HasSubstr;

/// Normal by Box and Muller from numbers that every library draws alike.
double normal(std::mt19937_64& random) {
  const auto uniform = [&] { return (static_cast<double>(random() >> 11U) + 0.5) / 9007199254740992.0; };
  const double size = std::sqrt(-2.0 * std::log(uniform()));
  return size * std::cos(2.0 * M_PI * uniform());
}

class Fit : public ::testing::Test {
 protected:
  std::filesystem::path write(const json& fit) const {
    write_file(folder_.path() / "fit.json", fit.dump());
    return folder_.path() / "fit.json";
  }
  void write_curve(const std::string& header, const std::vector<double>& x, const std::vector<double>& y) const {
    std::string csv = header + "\n";
    for (std::size_t i = 0; i < x.size(); ++i) csv += std::to_string(x[i]) + "," + std::to_string(y[i]) + "\n";
    write_file(folder_.path() / "curve.csv", csv);
  }
  /// A problem whose curve is what the planted values give, with noise of 2 % of the largest value.
  FitProblem planted(const json& fit, const std::vector<double>& values, std::uint64_t seed) const {
    FitProblem problem = load_fit(write(fit));
    plant(values, seed, problem);
    return problem;
  }
  static void plant(const std::vector<double>& values, std::uint64_t seed, FitProblem& problem) {
    std::mt19937_64 random(seed);
    const std::vector<double> exact = problem.predict(model_with(problem, values));
    double largest = 0.0;
    for (const double y : exact) largest = std::max(largest, std::abs(y));
    std::size_t i = 0;
    for (FitCurve& curve : problem.curves) {
      for (double& y : curve.y) y = exact[i++] + 0.02 * largest * normal(random);
    }
  }
  static void expect_found(const FitAnswer& answer, const std::vector<double>& values) {
    EXPECT_TRUE(answer.fit.converged);
    for (std::size_t j = 0; j < values.size(); ++j) EXPECT_NEAR(answer.fit.values[j] / values[j], 1.0, 0.05) << j;
  }

  testing::TemporaryFolder folder_;
};

/// Fibres of 30 mm on a tendon of 100 mm, stretched to 1.5 lo.
json passive_fit() {
  return {{"schema", 1},
          {"kind", "passive_length_tension"},
          {"model",
           {{"peak_force_N", 100},
            {"optimal_fibre_m", 0.03},
            {"pennation_rad", 0.2},
            {"tendon", "elastic"},
            {"tendon_slack_m", 0.1}}},
          {"measurements", {{{"file", "curve.csv"}}}},
          {"parameters",
           {{{"name", "optimal_fibre_m"}, {"start", 0.02}, {"low", 0.005}, {"high", 0.1}},
            {{"name", "passive_strain"}, {"start", 0.4}, {"low", 0.1}, {"high", 2.0}}}}};
}

class PassiveFit : public Fit {
 protected:
  void SetUp() override {
    std::vector<double> x, y;
    for (int i = 0; i <= 60; ++i) x.push_back(0.128 + 0.018 * i / 60.0);
    y.assign(x.size(), 0.0);
    write_curve("length_m,force_N", x, y);
  }
  const std::vector<double> planted_{0.031, 0.62};
};

TEST_F(PassiveFit, FindsWhatWasPlanted) {
  const FitProblem problem = planted(passive_fit(), planted_, 1);
  const FitAnswer answer = fit(problem);
  expect_found(answer, planted_);
  EXPECT_GT(answer.r_squared, 0.99);
  EXPECT_TRUE(answer.warnings.empty());
}

// With a true coverage of 0.95, fewer than 177 or more than 199 of 200 have a probability below 0.1 % each.
TEST_F(PassiveFit, IntervalsHoldThePlantedValueInNinetyFivePercent) {
  FitProblem problem = load_fit(write(passive_fit()));
  std::vector<int> held(planted_.size(), 0);
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    plant(planted_, 1000 + static_cast<std::uint64_t>(run), problem);
    const FitAnswer answer = fit(problem);
    for (std::size_t j = 0; j < planted_.size(); ++j) {
      const FitInterval& interval = answer.statistics.of[j];
      held[j] += interval.known && interval.low <= planted_[j] && planted_[j] <= interval.high ? 1 : 0;
    }
  }
  for (const int count : held) {
    RecordProperty("held", count);
    EXPECT_GE(count, 177);
    EXPECT_LE(count, 199);
  }
}

TEST_F(PassiveFit, TwiceTheSameFitIsTheSame) {
  const FitProblem problem = planted(passive_fit(), planted_, 3);
  EXPECT_EQ(fit_json(problem, fit(problem)).dump(), fit_json(problem, fit(problem)).dump());
}

TEST_F(PassiveFit, SaysWhichCombinationIsKnown) {
  json wish = passive_fit();  // scales of all muscle forces twice: only their product acts
  wish["model"]["tendon"] = "rigid";
  wish["parameters"] = {
      {{"name", "peak_force_N"}, {"relative", true}, {"start", 1}, {"low", 0.1}, {"high", 10}},
      {{"name", "again"}, {"keys", {"peak_force_N"}}, {"relative", true}, {"start", 1}, {"low", 0.1}, {"high", 10}}};
  const FitProblem problem = planted(wish, {1.2, 1.0}, 4);
  const FitAnswer answer = fit(problem);
  ASSERT_FALSE(answer.warnings.empty());
  EXPECT_THAT(answer.warnings.front(), AllOf(HasSubstr("peak_force_N by +10 %"), HasSubstr("again by -10 %")));
  EXPECT_FALSE(answer.statistics.of[0].known);
}

TEST_F(PassiveFit, SaysThatAParameterSitsAtItsBound) {
  json wish = passive_fit();
  wish["parameters"][0]["high"] = 0.028;
  FitProblem problem = load_fit(write(wish));
  FitProblem wide = load_fit(write(passive_fit()));
  plant(planted_, 5, wide);
  problem.curves = wide.curves;
  const FitAnswer answer = fit(problem);
  EXPECT_EQ(answer.fit.bound[0], 1);
  EXPECT_THAT(answer.warnings.front(), HasSubstr("optimal_fibre_m sits at its upper bound"));
}

TEST_F(PassiveFit, WrongFitsAreBadData) {
  const auto says = [&](const json& wish) { return complaint(ExitStatus::BadData, [&] { load_fit(write(wish)); }); };
  json wish = passive_fit();
  wish["parameters"][0]["low"] = 0.2;
  EXPECT_THAT(says(wish), HasSubstr("/parameters/0/high: is 0.1, not above low, 0.2; exchange them"));
  wish = passive_fit();
  wish["parameters"][0]["start"] = 0.5;
  EXPECT_THAT(says(wish), HasSubstr("must lie between low, 0.005, and high, 0.1"));
  wish = passive_fit();
  wish["parameters"][0]["name"] = "optimal_fiber_m";
  EXPECT_THAT(says(wish), HasSubstr("the nearest is \"optimal_fibre_m\""));
  wish = passive_fit();
  wish["model"]["tendon"] = "rigid";
  wish["model"]["tendon_slack_m"] = 1.0;
  EXPECT_THAT(says(wish), HasSubstr("changes nothing of these curves"));
  write_file(folder_.path() / "curve.csv", "length_m,power_W\n0.13,1\n");
  EXPECT_THAT(says(passive_fit()), HasSubstr("has no column of the force"));
  write_file(folder_.path() / "curve.csv", "length_m,force_N\n0.13,nan\n");
  EXPECT_THAT(says(passive_fit()), HasSubstr("line 2: force_N is \"nan\""));
  write_file(folder_.path() / "curve.csv", "length_m,force_N\n0.13,1\n");
  EXPECT_THAT(says(passive_fit()), HasSubstr("has 2 parameters, but the curves have 1 points"));
}

TEST_F(Fit, JointTorqueOfALineModelIsFoundAgain) {
  std::vector<double> x, y;
  for (int i = 0; i <= 50; ++i) x.push_back(-5.0 + 65.0 * i / 50.0);
  y.assign(x.size(), 0.0);
  write_curve("angle_deg,torque_Nm", x, y);
  const std::string model = (data_folder() / "assets" / "cases" / "line_elbow.json").string();
  const json wish = {
      {"schema", 1},
      {"kind", "joint_torque"},
      {"model", model},
      {"measurements", {{{"file", "curve.csv"}, {"activations", {{"flexors", 1}}}}, {{"file", "curve.csv"}}}},
      {"parameters",
       {{{"name", "flexors' strength"},
         {"keys", {"muscles.biceps_brachii.peak_force_N", "muscles.brachialis.peak_force_N"}},
         {"relative", true},
         {"start", 1},
         {"low", 0.2},
         {"high", 5}},
        {{"name", "spring.stiffness_Nm_rad"}, {"start", 0.5}, {"low", 0.01}, {"high", 20}}}}};
  const std::vector<double> values = {1.3, 1.1};
  expect_found(fit(planted(wish, values, 6)), values);
}

/// A punch of 5 mm on a block of 60 x 60 x 20 mm.
json indentation_fit(const std::string& shape) {
  return {
      {"schema", 1},
      {"kind", "indentation"},
      {"model",
       {{"block", {{"width_m", 0.06}, {"thickness_m", 0.03}, {"cells", 2}}},
        {"indenter", {{"shape", shape}, {"radius_m", 0.005}}},
        {"materials", {{{"law", "neo_hookean"}, {"parameters", {{"young_Pa", 30000}, {"poisson", 0.45}}}}}}}},
      {"measurements", {{{"file", "curve.csv"}}}},
      {"parameters", {{{"name", "materials.0.parameters.young_Pa"}, {"start", 15000}, {"low", 1000}, {"high", 1e6}}}}};
}

TEST_F(Fit, IndentationFindsTheModulus) {
  std::vector<double> x, y;
  for (int i = 1; i <= 30; ++i) x.push_back(0.001 * i / 30.0);
  y.assign(x.size(), 0.0);
  write_curve("depth_m,force_N", x, y);
  for (const char* shape : {"punch", "sphere"}) {
    const FitProblem problem = planted(indentation_fit(shape), {30000.0}, 7);
    expect_found(fit(problem), {30000.0});
  }
}

}  // namespace
}  // namespace myotact::measure
