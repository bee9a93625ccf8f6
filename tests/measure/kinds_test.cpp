#include "measure/validation/kinds.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/complaint.h"

namespace myotact::measure {
namespace {

using myotact::testing::complaint;
using ::testing::HasSubstr;

Quantities run_kind(const std::string& name, const std::string& inputs) {
  const auto& kinds = validation_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.name == name; });
  if (kind == kinds.end()) throw std::runtime_error("no kind " + name);
  const nlohmann::json json = parse_json(inputs, "inputs");
  JsonObject object(JsonValue(json, "inputs"));
  Quantities quantities = kind->run(object);
  object.finish();
  return quantities;
}

std::string refusal(const std::string& name, const std::string& inputs) {
  return complaint(ExitStatus::BadData, [&] { run_kind(name, inputs); });
}

TEST(ValidationKinds, HaveDistinctNames) {
  std::vector<std::string> names;
  for (const Kind& kind : validation_kinds()) names.push_back(kind.name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

TEST(ValidationKinds, QuantitiesCarryTheShortestTextOfTheirPlace) {
  EXPECT_EQ(quantity_at("active", 0.1), "active(0.1)");
  EXPECT_EQ(quantity_at("active", 1.0), "active(1)");
  EXPECT_EQ(quantity_at("force_velocity", -0.75), "force_velocity(-0.75)");
}

TEST(ValidationKinds, OscillatorMatchesTheRootsOfItsRules) {
  // Backward Euler: 1 / (1 - i x), x = omega dt, over 2 pi / x steps.
  const double x = 2.0 * 3.14159265358979323846 * 0.05;
  const Quantities euler = run_kind("oscillator", R"({"rule": "backward_euler", "frequency_hz": 5, "dt_s": 0.01})");
  EXPECT_NEAR(euler.at("amplitude_kept_per_period"), std::pow(1.0 + x * x, -10.0), 1e-12);
  EXPECT_NEAR(euler.at("frequency_ratio"), std::atan(x) / x, 1e-12);
  const Quantities trapezoid = run_kind("oscillator", R"({"rule": "trapezoid", "frequency_hz": 5, "dt_s": 0.01})");
  EXPECT_NEAR(trapezoid.at("amplitude_kept_per_period"), 1.0, 1e-12);
  EXPECT_NEAR(trapezoid.at("frequency_ratio"), 2.0 * std::atan(0.5 * x) / x, 1e-12);
}

TEST(ValidationKinds, PendulumFromNearTheTopTakesTheLongPeriod) {
  const Quantities high = run_kind("hinge_pendulum", R"({"length_m": 0.3, "mass_kg": 1, "gravity_m_s2": 9.81,
                                                         "amplitude_rad": 3.0, "dt_s": 0.001})");
  constexpr double kElliptic = 4.0389;  // K(sin 1.5) = ln(4 / cos 1.5) + ... to five digits
  const double exact_s = 4.0 * std::sqrt(0.2 / 9.81) * kElliptic;
  EXPECT_NEAR(high.at("period_s"), exact_s, 2e-3 * exact_s);  // near the top a step's error grows before it is counted
}

TEST(ValidationKinds, RefuseWhatTheyCannotCompute) {
  EXPECT_THAT(refusal("oscillator", R"({"rule": "bdf2", "frequency_hz": 5, "dt_s": 0.01})"), HasSubstr("/rule"));
  EXPECT_THAT(refusal("oscillator", R"({"rule": "trapezoid", "frequency_hz": 100, "dt_s": 0.01})"), HasSubstr("/dt_s"));
  EXPECT_THAT(refusal("oscillator", R"({"rule": "trapezoid", "frequency_hz": 1, "dt_s": 0.01, "end_s": 1})"),
              HasSubstr("/end_s: unknown key"));
  EXPECT_THAT(refusal("oscillator_order",
                      R"({"rule": "trapezoid", "frequency_hz": 1, "dt_s": 0.01, "end_s": 0.015, "halvings": 1})"),
              HasSubstr("/end_s: is 0.015 s; must be a whole multiple of dt_s = 0.01"));
  EXPECT_THAT(refusal("force_curves", R"({"curve_set": "millard"})"), HasSubstr("nearest: \"millard_2012\""));
  EXPECT_THAT(refusal("isotonic_velocity", R"({"curve_set": "millard_2012"})"), HasSubstr("\"loads\" is missing"));
  EXPECT_THAT(refusal("hinge_pendulum", R"({"length_m": 0.3, "mass_kg": 1, "gravity_m_s2": 0, "amplitude_rad": 1,
                                           "dt_s": 0.001})"),
              HasSubstr("/gravity_m_s2"));
}

}  // namespace
}  // namespace myotact::measure
