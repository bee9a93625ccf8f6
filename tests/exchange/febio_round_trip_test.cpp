// A case that is written for FEBio and read again has the same displacements: there is no FEBio among the packages of
// Debian, so that its own answers are those of febio_models_test alone.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exchange/febio_read.h"
#include "exchange/febio_write.h"
#include "measure/case_example.h"
#include "measure/solve_answer.h"

namespace myotact::exchange {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::vector<Vec3> displacements_m(const measure::SolveCase& input) {
  const measure::SolveAnswer answer = measure::solve_case(input, [](const auto&) {});
  EXPECT_TRUE(answer.converged);
  std::vector<Vec3> out;
  for (std::size_t n = 0; n < input.mesh.mesh.nodes_m.size(); ++n) {
    out.push_back(answer.deformed.mesh.nodes_m[n] - input.mesh.mesh.nodes_m[n]);
  }
  return out;
}

/// Largest distance between the two over the largest displacement.
double difference(const measure::SolveCase& ours, const measure::SolveCase& again) {
  const std::vector<Vec3> a = displacements_m(ours), b = displacements_m(again);
  EXPECT_EQ(a.size(), b.size());
  double farthest = 0.0, largest = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    farthest = std::max(farthest, (a[n] - b[n]).norm());
    largest = std::max(largest, a[n].norm());
  }
  EXPECT_GT(largest, 1e-6);
  return farthest / largest;
}

struct NamedMaterials {
  const char* name;
  const char* materials;
  double traction_Pa = 2000.0;
};

// GoogleTest looks for this name.
// NOLINTNEXTLINE(readability-identifier-naming)
void PrintTo(const NamedMaterials& one, std::ostream* out) {
  *out << one.name;
}

class FebioRoundTrip : public ::testing::TestWithParam<NamedMaterials> {
 protected:
  static measure::SolveCase case_of(const NamedMaterials& one, const char* element) {
    json input = measure::example_case();
    input["element"] = element;
    input["materials"] = json::parse(one.materials);
    input["fibre"] = {{"direction", {0.8, 0.6, 0.0}}};
    input["conditions"][1]["value"] = {one.traction_Pa, 0.0, -0.3 * one.traction_Pa};
    input["conditions"].push_back({{"kind", "activation"}, {"value", 0.4}});
    input["conditions"][0]["ramp"] = 4;
    return measure::CaseFolder().load(input);
  }
};

TEST_P(FebioRoundTrip, DisplacementsAreTheSame) {
  for (const char* element : {"T4", "T10"}) {
    const measure::SolveCase ours = case_of(GetParam(), element);
    const FebioCase again = parse_febio(febio_text(ours).text, "again.feb");
    EXPECT_LT(difference(ours, again.solve_case), 1e-9) << element;
    EXPECT_EQ(again.solve_case.load_steps, ours.load_steps);
  }
}

constexpr const char* kNeoHookean = R"([{"law": "neo_hookean", "parameters": {"shear_Pa": 1e4, "lambda_Pa": 4e4}}])";

INSTANTIATE_TEST_SUITE_P(
    EveryLaw, FebioRoundTrip,
    ::testing::Values(
        NamedMaterials{"neo_hookean", kNeoHookean},
        NamedMaterials{"stable_neo_hookean",
                       R"([{"law": "stable_neo_hookean", "parameters": {"young_Pa": 3e4, "poisson": 0.45}}])"},
        NamedMaterials{"mooney_rivlin",
                       R"([{"law": "mooney_rivlin", "parameters": {"c1_Pa": 6e3, "c2_Pa": 2e3, "bulk_Pa": 1e5}}])"},
        NamedMaterials{"blemker_muscle",
                       R"([{"law": "blemker_muscle", "parameters": {"along_Pa": 5e3, "across_Pa": 6e3, "bulk_Pa": 1e5,
                           "peak_Pa": 2e4, "optimal_stretch": 1.05}}])"},
        NamedMaterials{"blemker_tendon",
                       R"([{"law": "blemker_tendon", "parameters": {"along_Pa": 5e3, "across_Pa": 6e3, "bulk_Pa": 1e5,
                           "toe_Pa": 2e3, "exponent": 8, "straight_stretch": 1.1}}])"},
        NamedMaterials{"trans_iso",
                       R"([{"law": "mooney_rivlin", "parameters": {"c1_Pa": 6e3, "bulk_Pa": 1e5}},
                           {"law": "isochoric_exponential_fibre", "parameters": {"toe_Pa": 2e3, "exponent": 8,
                            "straight_Pa": 4e4, "straight_stretch": 1.1}}])"},
        NamedMaterials{"calcium",
                       R"([{"law": "mooney_rivlin", "parameters": {"c1_Pa": 6e3, "bulk_Pa": 1e5}},
                           {"law": "isochoric_exponential_fibre", "parameters": {"toe_Pa": 2e3, "exponent": 8,
                            "straight_stretch": 1.1}},
                           {"law": "calcium_tension", "parameters": {"peak_Pa": 5e3, "calcium_umol": 4.35,
                            "largest_calcium_umol": 4.35, "steepness_1_um": 4.75, "shortest_um": 1.58,
                            "reference_um": 2.04}}])"},
        NamedMaterials{"coupled",
                       R"([{"law": "neo_hookean", "parameters": {"shear_Pa": 1e4, "lambda_Pa": 4e4}},
                           {"law": "exponential_fibre", "parameters": {"toe_Pa": 2e3, "exponent": 8,
                            "straight_stretch": 1.1}}])"},
        NamedMaterials{"muscle_fibre",
                       R"([{"law": "stable_neo_hookean", "parameters": {"shear_Pa": 1e4, "lambda_Pa": 1e5}},
                           {"law": "muscle_fibre", "parameters": {"peak_Pa": 2e4, "rest_length": 0.9, "gain": 1.3,
                            "curves": "thelen_2003"}}])"},
        NamedMaterials{"tensions",
                       R"([{"law": "neo_hookean", "parameters": {"shear_Pa": 1e4, "lambda_Pa": 4e4}},
                           {"law": "fibre_tension", "parameters": {"tension_Pa": 4e3}},
                           {"law": "isotropic_tension", "parameters": {"tension_Pa": 3e3}}])"}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(FebioText, LoadsSupportsAndMotionComeBack) {
  json input = measure::example_case();
  input["conditions"][1] = {{"set", "tip"}, {"kind", "displace"}, {"value", {0.1, nullptr, -0.05}}};
  input["conditions"].push_back({{"set", "tip"}, {"kind", "pressure"}, {"value", 500}});
  input["conditions"].push_back({{"kind", "gravity"}, {"value", {0, 1, -3}}});
  const measure::CaseFolder folder;
  for (const char* element : {"T4", "T10"}) {
    input["element"] = element;
    const measure::SolveCase ours = folder.load(input);
    const measure::SolveCase again = parse_febio(febio_text(ours).text, "again.feb").solve_case;
    EXPECT_EQ(again.loads.pressure.size(), ours.loads.pressure.size());
    EXPECT_EQ(again.loads.gravity_m_s2, ours.loads.gravity_m_s2);
    EXPECT_LT(difference(ours, again), 1e-9) << element;
  }
  input["dynamics"] = "bdf2";
  input["dt_s"] = 0.01;
  input["t_end_s"] = 0.1;
  const measure::SolveCase ours = folder.load(input);
  const measure::SolveCase again = parse_febio(febio_text(ours).text, "again.feb").solve_case;
  EXPECT_EQ(again.dt_s, ours.dt_s);
  EXPECT_NEAR(again.t_end_s, ours.t_end_s, 1e-12);
  EXPECT_LT(difference(ours, again), 1e-9);
}

TEST(FebioText, PatchedTetsBecomeNodallyAveragedOnes) {
  json input = measure::example_case();
  input["element"] = "T4F";
  const FebioText text = febio_text(measure::CaseFolder().load(input));
  EXPECT_THAT(text.text, HasSubstr("type=\"ut4-solid\""));
  EXPECT_EQ(parse_febio(text.text, "again.feb").solve_case.element, measure::Element::T4F);
}

/// Equal moduli are equal at rest only, and the file says by how much not elsewhere.
TEST(FebioText, WhatHasNoLikeIsSaidOrRefused) {
  json input = measure::example_case();
  input["materials"][0]["law"] = "corotated";
  const measure::CaseFolder folder;
  const FebioText text = febio_text(folder.load(input));
  ASSERT_FALSE(text.notes.empty());
  EXPECT_THAT(text.notes[0], HasSubstr("corotated has no like in FEBio"));
  EXPECT_THAT(text.text, HasSubstr("corotated has no like in FEBio"));
  input = measure::example_case();
  input["fibre"] = {{"direction", {1, 0, 0}}};
  input["materials"].push_back(json::parse(R"({"law": "isochoric_muscle_fibre", "parameters": {"peak_Pa": 1e4}})"));
  const std::string problem = myotact::testing::complaint(ExitStatus::BadData, [&] { febio_text(folder.load(input)); });
  EXPECT_THAT(problem, HasSubstr("no like in FEBio"));
  EXPECT_THAT(problem, HasSubstr("law 2"));
}

}  // namespace
}  // namespace myotact::exchange
