// Finite-element cases through the program: the documented example, every kind of failure, and a signal.

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "core/file.h"
#include "support/source_folder.h"

namespace myotact::testing {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kExample = source_folder() + "/assets/cases/cantilever.json";

class Solve : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
    return (folder_.path() / name).string();
  }
  Outcome solve(const json& input) const { return run_program("solve " + file("case.json", input.dump())); }
  /// The complaint about the example with one value replaced or added.
  std::string problem(const char* pointer, const json& value) const {
    json changed = example_;
    changed[json::json_pointer(pointer)] = value;
    const Outcome outcome = solve(changed);
    EXPECT_EQ(outcome.status, 65) << outcome.output;
    return outcome.output;
  }

  json example_ = json::parse(read_file(kExample), nullptr, true, true);
  TemporaryFolder folder_;
};

TEST_F(Solve, TheExampleBendsAsTheReadmeSays) {
  const auto vtk = folder_.path() / "bent.vtk";
  // A slow build also writes progress, on standard error.
  const Outcome outcome = run_program("solve " + kExample + " --vtk " + vtk.string() + " 2>/dev/null");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const json answer = json::parse(outcome.output);
  EXPECT_EQ(answer["case"], "cantilever");
  EXPECT_EQ(answer["converged"], true);
  EXPECT_GT(answer["iterations"], 0);
  const auto tip = answer["outputs"]["tip.displacement.mean"];
  // Slender-beam theory says 4 mm; the held root, which cannot swell, and the mesh keep 1.3 % of it.
  EXPECT_NEAR(tip[2].get<double>(), -3.95e-3, 0.03e-3);
  EXPECT_NEAR(tip[1].get<double>(), 0.0, 1e-9);
  EXPECT_NEAR(answer["outputs"]["root.reaction.sum"][2].get<double>(), 0.003, 1e-8);
  EXPECT_EQ(answer["units"]["all.energy.sum"], "J");
  EXPECT_THAT(read_file(vtk),
              AllOf(HasSubstr("VECTORS displacement double"), HasSubstr("SCALARS volume_ratio double 1"),
                    HasSubstr("SCALARS von_mises double 1")));
}

TEST_F(Solve, BadCasesAreRefusedWithPlaceAndRemedy) {
  EXPECT_THAT(problem("/materials/0/parameters/poisson", 0.5), HasSubstr("poisson: is 0.5; must be > -1 and < 0.5"));
  EXPECT_THAT(problem("/materials/0/parameters/young_Pa", -1), HasSubstr("young_Pa: is -1; must be > 0"));
  EXPECT_THAT(problem("/sets/tip/plane/value", 0.2), HasSubstr("the nearest node is 0.1 m away"));
  EXPECT_THAT(problem("/conditions/0/set", "rot"), HasSubstr("nearest: \"root\""));
  EXPECT_THAT(problem("/conditions", json::array()), HasSubstr("can move as a rigid body"));
  EXPECT_THAT(problem("/elment", "T4"), HasSubstr("nearest known one is \"element\""));
  EXPECT_THAT(problem("/materials/-", {{"law", "muscle_fibre"}, {"parameters", {{"peak_Pa", 3e5}}}}),
              HasSubstr("has no fibre"));
  file("flat.node", "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 1 1 0\n");
  file("flat.ele", "1 4\n0 0 1 2 3\n");
  EXPECT_THAT(problem("/mesh", "flat.ele"), AllOf(HasSubstr("flat.ele: tet 0"), HasSubstr("volume 0 m^3")));
}

TEST_F(Solve, MissingFilesAreNoInputAndAFolderThatCannotBeIsInputOutput) {
  EXPECT_EQ(run_program("solve " + (folder_.path() / "nothing.json").string()).status, 66);
  example_["mesh"] = "nothing.vtk";
  EXPECT_EQ(solve(example_).status, 66);
  // Known before the solve, which has answered nothing.
  for (const std::string& vtk : {std::string("/proc/nowhere/m.vtk"), std::string("/proc/m.vtk"),
                                 folder_.path().string(), file("taken", "") + "/m.vtk", std::string("''")}) {
    const Outcome outcome = run_program("solve " + kExample + " --vtk " + vtk);
    EXPECT_EQ(outcome.status, 74) << vtk;
    EXPECT_THAT(outcome.output, ::testing::Not(HasSubstr("outputs"))) << vtk;
  }
  EXPECT_EQ(run_program("solve").status, 2);
}

TEST_F(Solve, WhatDoesNotConvergeSaysSoAndKeepsTheLastState) {
  example_["mesh"]["box"]["cells"] = {4, 1, 1};
  example_["element"] = "T4";
  example_["materials"][0]["law"] = "neo_hookean";  // which no force turns inside out
  example_["conditions"][1] = {{"set", "tip"}, {"kind", "displace"}, {"value", {-0.15, 0, 0}}};
  const Outcome outcome = solve(example_);
  EXPECT_EQ(outcome.status, 1) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("\"converged\": false"), HasSubstr("did not converge")));
}

TEST_F(Solve, AMeshFileCutShortIsRefusedWithItsLine) {
  const std::string whole =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
      "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
  file("cut.vtk", whole.substr(0, whole.find("2 3\nCELL_TYPES")));
  EXPECT_THAT(problem("/mesh", "cut.vtk"), AllOf(HasSubstr("cut.vtk: line 11"), HasSubstr("cut short")));
  file("cut.vtk", whole.substr(0, whole.find("uble")));
  EXPECT_THAT(problem("/mesh", "cut.vtk"), HasSubstr("line 5: points are of the type \"do\"; must be double or float"));
}

TEST_F(Solve, ALoadFarBeyondTheStiffnessAsksForUnits) {
  example_["mesh"]["box"]["cells"] = {2, 1, 1};
  example_["element"] = "T4";
  example_["conditions"][1]["value"] = {-1e15, 0, 0};
  const Outcome outcome = solve(example_);
  EXPECT_EQ(outcome.status, 1) << outcome.output;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("\"steps\": 0"), HasSubstr("the answer is the body at rest"), HasSubstr("in Pa")));
}

TEST_F(Solve, AnEquilibriumInsideOutIsNoAnswer) {
  example_["mesh"]["box"] = {{"size_m", {2, 1, 1}}, {"cells", {2, 1, 1}}};
  example_["element"] = "T4";
  example_["materials"][0] = {{"law", "neo_hookean"}, {"parameters", {{"shear_Pa", 1e4}, {"lambda_Pa", 4e4}}}};
  example_["sets"]["tip"]["plane"]["value"] = 2;
  // The far face is taken through the held one: forces balance on the other side of volume 0, too.
  example_["conditions"][1] = {{"set", "tip"}, {"kind", "displace"}, {"value", {-2.09, 0, 0}}};
  const Outcome outcome = solve(example_);
  EXPECT_EQ(outcome.status, 1) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("\"converged\": false"), HasSubstr("inside out (volume ratio -")));
}

TEST_F(Solve, AMotionThatTurnsTetsInsideOutDoesNotConverge) {
  example_["mesh"]["box"]["cells"] = {4, 1, 1};
  example_["element"] = "T4";
  example_["dynamics"] = "bdf2";
  example_["dt_s"] = 1e-3;
  example_["t_end_s"] = 0.01;
  example_["materials"][0]["parameters"]["density_kg_m3"] = 1000;
  example_["conditions"][1] = {{"set", "tip"}, {"kind", "displace"}, {"value", {-0.15, 0, 0}}};
  const Outcome outcome = solve(example_);
  EXPECT_EQ(outcome.status, 1) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("\"converged\": false"), HasSubstr("smaller dt_s")));
}

TEST_F(Solve, ASignalEndsItWithNothingWritten) {
  example_["mesh"]["box"]["cells"] = {4, 1, 1};
  example_["dynamics"] = "bdf2";
  example_["dt_s"] = 1e-3;
  example_["t_end_s"] = 9999;  // longer than any test
  example_["materials"][0]["parameters"]["density_kg_m3"] = 1000;
  const auto vtk = folder_.path() / "m.vtk";
  const Outcome outcome = run_program("solve " + file("long.json", example_.dump()) + " --vtk " + vtk.string(),
                                      "timeout --preserve-status -s INT 3");
  EXPECT_EQ(outcome.status, 130) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("Newton steps"));  // it was under way for more than a second
  EXPECT_FALSE(std::filesystem::exists(vtk));
  EXPECT_THAT(outcome.output, ::testing::Not(HasSubstr("outputs")));
}

}  // namespace
}  // namespace myotact::testing
