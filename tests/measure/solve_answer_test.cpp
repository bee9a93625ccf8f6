#include "measure/solve_answer.h"

#include <cmath>
#include <stdexcept>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "measure/case_example.h"

// Cases whose answers are known in closed form, through the whole way from the file to the numbers.

namespace myotact::measure {
namespace {

using nlohmann::json;

constexpr double kShear_Pa = 1e4, kLambda_Pa = 4e4;  // of the example

/// Newton ends at 1e-8 of the elements' forces; what is left in stresses and stretches.
constexpr double kSolved = 1e-6;

class Answers : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    case_["element"] = GetParam();
    case_["sets"]["y"] = {{"plane", {{"axis", "y"}, {"value", 0}}}};
    case_["sets"]["z"] = {{"plane", {{"axis", "z"}, {"value", 0}}}};
    case_["conditions"] = json::array();
    for (const char* set : {"root", "y", "z"}) case_["conditions"].push_back({{"set", set}, {"kind", "symmetry"}});
    case_["outputs"] = json::array();
  }
  void condition(const json& entry) { case_["conditions"].push_back(entry); }
  void output(const char* set, const char* quantity, const char* reduce) {
    case_["outputs"].push_back({{"set", set}, {"quantity", quantity}, {"reduce", reduce}});
  }
  SolveAnswer solve() const {
    return solve_case(folder_.load(case_), [](const SolveProgress&) {});
  }

  json case_ = example_case();
  CaseFolder folder_;
};

const std::vector<double>& value_of(const SolveAnswer& answer, const std::string& name) {
  for (const auto& [output, values] : answer.outputs) {
    if (output.name == name) return values;
  }
  throw std::out_of_range(name);
}

/// Cauchy stress of the example's law at a diagonal deformation.
double stress_Pa(double stretch, double J) {
  return (kShear_Pa * (stretch * stretch - 1.0) + kLambda_Pa * std::log(J)) / J;
}

TEST_P(Answers, AUniaxialPullFollowsTheLaw) {
  condition({{"set", "tip"}, {"kind", "displace"}, {"value", {0.6, nullptr, nullptr}}});
  output("all", "stress", "mean");
  output("all", "volume_ratio", "mean");
  output("root", "reaction", "sum");
  const SolveAnswer answer = solve();
  ASSERT_TRUE(answer.converged);
  const double J = value_of(answer, "all.volume_ratio.mean")[0];
  const double across = std::sqrt(J / 1.3);
  EXPECT_NEAR(stress_Pa(across, J), 0.0, kSolved * kShear_Pa);
  const auto& stress = value_of(answer, "all.stress.mean");
  EXPECT_NEAR(stress[0], stress_Pa(1.3, J), kSolved * kShear_Pa);
  EXPECT_NEAR(stress[1], 0.0, kSolved * kShear_Pa);
  EXPECT_NEAR(stress[3], 0.0, kSolved * kShear_Pa);
  // The support pulls back with the stress over the present section.
  EXPECT_NEAR(value_of(answer, "root.reaction.sum")[0], -stress[0] * across * across, kSolved * kShear_Pa);
}

TEST_P(Answers, ADeadTractionGivesItsNominalStress) {
  condition({{"set", "tip"}, {"kind", "traction"}, {"value", {2000, 0, 0}}});
  output("all", "stress", "max");
  output("all", "stress", "mean");
  output("tip", "displacement", "max");
  output("all", "volume_ratio", "mean");
  const SolveAnswer answer = solve();
  ASSERT_TRUE(answer.converged);
  const double J = value_of(answer, "all.volume_ratio.mean")[0];
  const auto& mean = value_of(answer, "all.stress.mean");
  // Uniform: the largest von Mises stress is the mean axial stress.
  EXPECT_NEAR(value_of(answer, "all.stress.max")[0], mean[0], kSolved * kShear_Pa);
  // Nominal over true stress is the present over the rest section.
  const double section = 2000.0 / mean[0];
  EXPECT_NEAR(mean[0], stress_Pa(J / section, J), kSolved * kShear_Pa);
}

TEST_P(Answers, PressureAllRoundIsHydrostatic) {
  for (const auto& [name, axis, value] :
       {std::tuple("x1", "x", 2), std::tuple("y1", "y", 1), std::tuple("z1", "z", 1)}) {
    case_["sets"][name] = {{"plane", {{"axis", axis}, {"value", value}}}};
    condition({{"set", name}, {"kind", "pressure"}, {"value", 5000}});
  }
  output("all", "stress", "mean");
  output("all", "volume_ratio", "max");
  const SolveAnswer answer = solve();
  ASSERT_TRUE(answer.converged);
  const auto& stress = value_of(answer, "all.stress.mean");
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(stress[k], k < 3 ? -5000.0 : 0.0, kSolved * kShear_Pa);
  const double J = value_of(answer, "all.volume_ratio.max")[0];
  EXPECT_NEAR(stress_Pa(std::cbrt(J), J), -5000.0, kSolved * kShear_Pa);
}

TEST_P(Answers, AFreeBodyFallsAsTheTimeRuleSays) {
  case_["conditions"] = {{{"kind", "gravity"}, {"value", {0, 0, -10}}}};
  case_["dynamics"] = "backward_euler";
  case_["dt_s"] = 0.01;
  case_["t_end_s"] = 0.1;
  output("all", "displacement", "mean");
  const SolveAnswer answer = solve();
  ASSERT_TRUE(answer.converged);
  EXPECT_EQ(answer.steps, 10);
  // g dt^2 (1 + 2 + .. + 10)
  EXPECT_NEAR(value_of(answer, "all.displacement.mean")[2], -10.0 * 1e-4 * 55.0, 1e-9);
}

/// A bar that carries its weight from above: the support of a motion that has come to rest holds all of it.
TEST_P(Answers, TheReactionOfAMotionAtRestIsTheWeight) {
  condition({{"kind", "gravity"}, {"value", {-1, 0, 0}}});
  case_["dynamics"] = "backward_euler";
  case_["dt_s"] = 1.0;
  case_["t_end_s"] = 60.0;
  output("root", "reaction", "sum");
  const SolveAnswer answer = solve();
  ASSERT_TRUE(answer.converged);
  EXPECT_NEAR(value_of(answer, "root.reaction.sum")[0], 2000.0, 0.1);  // 2 m^3 of 1000 kg/m^3
}

INSTANTIATE_TEST_SUITE_P(EveryElement, Answers, ::testing::Values("T4", "T4F", "T10"),
                         [](const auto& info) { return info.param; });

TEST(SolveAnswerJson, HoldsNumbersVectorsAndUnits) {
  SolveAnswer answer;
  answer.name = "beam";
  answer.converged = true;
  CaseOutput output;
  output.name = "tip.displacement.mean";
  answer.outputs.emplace_back(output, std::vector<double>{0.0, 0.0, 0.25});
  output.name = "all.energy.sum";
  output.quantity = Quantity::Energy;
  answer.outputs.emplace_back(output, std::vector<double>{1.5});
  const json read = json::parse(answer_json(answer));
  EXPECT_EQ(read["case"], "beam");
  EXPECT_EQ(read["converged"], true);
  EXPECT_EQ(read["outputs"]["tip.displacement.mean"], (json{0.0, 0.0, 0.25}));
  EXPECT_EQ(read["outputs"]["all.energy.sum"], 1.5);
  EXPECT_EQ(read["units"]["all.energy.sum"], "J");
  EXPECT_EQ(read["units"]["tip.displacement.mean"], "m");
}

}  // namespace
}  // namespace myotact::measure
