#include "measure/solve_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "measure/case_example.h"
#include "measure/case_laws.h"

namespace myotact::measure {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

class SolveCaseFile : public ::testing::Test {
 protected:
  /// The complaint about the example with the value at a pointer replaced (or added).
  std::string problem(const char* pointer, const json& value) const {
    json changed = case_;
    changed[json::json_pointer(pointer)] = value;
    return folder_.problem(changed);
  }

  json case_ = example_case();
  CaseFolder folder_;
};

TEST_F(SolveCaseFile, TheExampleIsReadWhole) {
  const SolveCase out = folder_.load(case_);
  EXPECT_EQ(out.name, "case");
  EXPECT_EQ(out.mesh.mesh.corners.size(), 12U);
  EXPECT_EQ(out.loads.held.size(), 12U);
  // The whole traction arrives: 100 Pa over 1 m^2.
  EXPECT_NEAR(out.loads.nodal_force_N.sum(), 100.0, 1e-12);
  const auto& law = std::get<simulation::NeoHookean>(out.materials.at(0).laws.at(0));
  EXPECT_EQ(law.shear_Pa, 1e4);
  EXPECT_EQ(law.lambda_Pa, 4e4);
  EXPECT_EQ(out.outputs.at(0).name, "tip.displacement.mean");
  EXPECT_EQ(out.outputs.at(0).nodes.size(), 4U);
}

TEST_F(SolveCaseFile, EveryUnknownKeyNamesTheNearest) {
  EXPECT_THAT(problem("/elemnt", "T4"), AllOf(HasSubstr("/elemnt"), HasSubstr("nearest known one is \"element\"")));
  EXPECT_THAT(problem("/sets/root/plane/ax", "x"), HasSubstr("nearest known one is \"axis\""));
  EXPECT_THAT(problem("/materials/0/parameters/shear", 1), HasSubstr("\"shear_Pa\""));
  EXPECT_THAT(problem("/conditions/0/valu", 1), HasSubstr("/conditions/0/valu"));
  EXPECT_THAT(problem("/outputs/0/reduc", "sum"), HasSubstr("\"reduce\""));
  EXPECT_THAT(problem("/mesh/box/size", 1), HasSubstr("\"size_m\""));
}

TEST_F(SolveCaseFile, WrongChoicesNameTheAllowedOnes) {
  EXPECT_THAT(problem("/schema", 2), HasSubstr("/schema: is 2"));
  EXPECT_THAT(problem("/element", "T8"), AllOf(HasSubstr("/element"), HasSubstr("T4, T4F, T10")));
  EXPECT_THAT(problem("/dynamics", "bdf"), HasSubstr("nearest: \"bdf2\""));
  EXPECT_THAT(problem("/materials/0/law", "neo_hooke"), HasSubstr("nearest: \"neo_hookean\""));
  EXPECT_THAT(problem("/conditions/0/kind", "fixed"), HasSubstr("nearest: \"fix\""));
  EXPECT_THAT(problem("/outputs/0/quantity", "strain"), HasSubstr("must be one of displacement"));
}

TEST_F(SolveCaseFile, ModuliOutsideTheirRangeAreRefused) {
  const auto young = [&](double young_Pa, double poisson) {
    case_["materials"][0]["parameters"] = {{"young_Pa", young_Pa}, {"poisson", poisson}};
    return folder_.problem(case_);
  };
  EXPECT_THAT(young(3e4, 0.5), AllOf(HasSubstr("/materials/0/parameters/poisson: is 0.5"), HasSubstr("< 0.5")));
  EXPECT_THAT(young(3e4, -1), HasSubstr("must be > -1"));
  EXPECT_THAT(young(-3e4, 0.3), AllOf(HasSubstr("young_Pa: is -30000"), HasSubstr("must be > 0")));
  EXPECT_THAT(problem("/materials/0/parameters", {{"shear_Pa", 1e4}, {"lambda_Pa", -1e4}}), HasSubstr("bulk modulus"));
  EXPECT_THAT(problem("/materials/0/parameters", {{"shear_Pa", 1e4}, {"poisson", 0.3}}), HasSubstr("mixes two ways"));
  EXPECT_THAT(problem("/materials/0/parameters", {{"shear_Pa", 1e4}}), HasSubstr("\"lambda_Pa\" is missing"));
}

TEST_F(SolveCaseFile, YoungAndPoissonBecomeLame) {
  case_["materials"][0]["parameters"] = {{"young_Pa", 3e4}, {"poisson", 0.25}};
  const SolveCase out = folder_.load(case_);
  const auto& law = std::get<simulation::NeoHookean>(out.materials.at(0).laws.at(0));
  EXPECT_NEAR(law.shear_Pa, 1.2e4, 1e-8);
  EXPECT_NEAR(law.lambda_Pa, 1.2e4, 1e-8);
}

TEST_F(SolveCaseFile, EntriesOfARegionAddUpAndNeedAMatrix) {
  const json fibre = {{"law", "muscle_fibre"}, {"parameters", {{"peak_Pa", 3e5}}}};
  case_["fibre"] = {{"direction", {2, 0, 0}}};
  case_["materials"].push_back(fibre);
  const SolveCase out = folder_.load(case_);
  EXPECT_EQ(out.materials.at(0).laws.size(), 2U);
  EXPECT_EQ(out.mesh.fibres.at(0), Vec3(1, 0, 0));
  EXPECT_THAT(problem("/materials", json::array({fibre})), HasSubstr("region 0 has no matrix"));
  EXPECT_THAT(problem("/materials/1/parameters/density_kg_m3", 900),
              HasSubstr("another entry of the region says 1000"));
  EXPECT_THAT(problem("/materials/1/parameters/peak_Pa", 0), HasSubstr("peak_Pa: is 0; must be > 0"));
  EXPECT_THAT(problem("/materials/1/region", 4), HasSubstr("no tet has the region 4; the mesh has 0"));
  EXPECT_THAT(problem("/fibre", {{"direction", {0, 0, 0}}}), HasSubstr("longer than 0"));
  case_.erase("fibre");
  // A box has no cell vectors that could be named as a remedy.
  EXPECT_THAT(folder_.problem(case_), AllOf(HasSubstr("tet 0 of region 0 has no fibre"), HasSubstr("direction"),
                                            ::testing::Not(HasSubstr("cell vectors"))));
}

TEST_F(SolveCaseFile, EveryLawOfTheReadmeIsRead) {
  const json elastic = {{"young_Pa", 3e4}, {"poisson", 0.4}};
  const json muscle = {{"peak_Pa", 3e5}};
  const json tendon = {{"toe_Pa", 1e4}, {"exponent", 30}, {"straight_Pa", 1e7}, {"straight_stretch", 1.05}};
  const json shear = {{"along_Pa", 1e3}, {"across_Pa", 1e3}, {"bulk_Pa", 1e6}};
  const auto with = [](json a, const json& b) {
    a.update(b);
    return a;
  };
  const json calcium = {{"peak_Pa", 1e5},         {"calcium_umol", 4},   {"largest_calcium_umol", 4},
                        {"steepness_1_um", 4.75}, {"shortest_um", 1.58}, {"reference_um", 2.04}};
  const std::vector<std::pair<std::string, json>> laws = {
      {"stable_neo_hookean", elastic},
      {"corotated", elastic},
      {"mooney_rivlin", {{"c1_Pa", 1e3}, {"c2_Pa", 100}, {"bulk_Pa", 1e6}}},
      {"blemker_muscle", with(shear, muscle)},
      {"blemker_tendon", with(shear, tendon)},
      {"muscle_fibre", muscle},
      {"isochoric_muscle_fibre", muscle},
      {"blemker_fibre", muscle},
      {"exponential_fibre", tendon},
      {"isochoric_exponential_fibre", tendon},
      {"fibre_tension", {{"tension_Pa", 1e4}}},
      {"calcium_tension", calcium},
      {"isotropic_tension", {{"tension_Pa", 1e4}}}};
  case_["fibre"] = {{"direction", {1, 0, 0}}};
  for (const auto& [law, parameters] : laws) {
    json changed = case_;
    changed["materials"].push_back({{"law", law}, {"parameters", parameters}});
    EXPECT_EQ(folder_.load(changed).materials.at(0).laws.size(), 2U) << law;
  }
}

TEST_F(SolveCaseFile, TheDefaultFluctuationLeavesCompressibleLawsAlone) {
  // lambda + mu of the volume term where that is small, four times mu where it is not.
  EXPECT_EQ(default_fluctuation_Pa({simulation::NeoHookean{1e4, 2e4}}), 3e4);
  EXPECT_EQ(default_fluctuation_Pa({simulation::NeoHookean{1e4, 1e6}}), 4e4);
  EXPECT_EQ(default_fluctuation_Pa({simulation::Corotated{1e4, 1e6}}), 0.0);
}

TEST_F(SolveCaseFile, ConditionsAreChecked) {
  EXPECT_THAT(problem("/conditions/0/set", "rooot"), AllOf(HasSubstr("/conditions/0/set"), HasSubstr("\"root\"")));
  EXPECT_THAT(problem("/conditions/1/value", {1, 2}), HasSubstr("must have 3"));
  EXPECT_THAT(problem("/conditions/1/value", {1, 2, 1e300}), HasSubstr("must be between"));
  EXPECT_THAT(problem("/conditions/-", {{"set", "root"}, {"kind", "displace"}, {"value", {1, nullptr, nullptr}}}),
              HasSubstr("another condition at 0"));
  EXPECT_THAT(problem("/conditions/-", {{"kind", "activation"}, {"value", 1.5}}), HasSubstr("between 0 and 1"));
  EXPECT_THAT(problem("/conditions/-", {{"kind", "gravity"}, {"set", "tip"}, {"value", {0, 0, 1}}}),
              HasSubstr("acts on the whole body"));
  case_["sets"]["edge"] = {{"nodes", {0, 1}}};
  EXPECT_THAT(problem("/conditions/1/set", "edge"), HasSubstr("no triangle of the surface"));
  EXPECT_THAT(problem("/conditions/-", {{"set", "edge"}, {"kind", "symmetry"}}), HasSubstr("a set that is a plane"));
  case_["materials"][0]["parameters"].erase("density_kg_m3");
  EXPECT_THAT(problem("/conditions/-", {{"kind", "gravity"}, {"value", {0, 0, -9.81}}}),
              HasSubstr("region 0 has no density_kg_m3"));
}

TEST_F(SolveCaseFile, NumbersThatAreNoneAreRefused) {
  const auto raw = [&](const std::string& value) {
    std::string text = case_.dump();
    text.replace(text.find("[100,0,0]"), 9, "[" + value + ",0,0]");
    write_file(folder_ / "raw.json", text);
    return myotact::testing::complaint(ExitStatus::BadData, [&] { load_case(folder_ / "raw.json"); });
  };
  EXPECT_THAT(raw("1e999"), HasSubstr("beyond 1.8e308"));
  EXPECT_THAT(raw("NaN"), AllOf(HasSubstr("raw.json: 1:"), HasSubstr("write a finite one")));
  EXPECT_THAT(raw("null"), HasSubstr("/conditions/1/value/0: is null; must be a number"));
  EXPECT_THAT(raw("\"100\""), HasSubstr("/conditions/1/value/0: is \"100\"; must be a number"));
  EXPECT_THAT(problem("/conditions/1/value", 100), HasSubstr("/conditions/1/value: is 100; must be a list of 3"));
}

TEST_F(SolveCaseFile, WhatNothingHoldsIsNamed) {
  EXPECT_THAT(problem("/conditions/0", {{"set", "root"}, {"kind", "symmetry"}}),
              AllOf(HasSubstr("tet 0: the part of 12 tets"), HasSubstr("3 of 6 motions")));
  EXPECT_THAT(problem("/conditions", json::array()), HasSubstr("0 of 6 motions"));
  // Two tets apart from each other, the second in the air.
  write_file(folder_ / "two.node", "8 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 5 0 0\n5 6 0 0\n6 5 1 0\n7 5 0 1\n");
  write_file(folder_ / "two.ele", "2 4\n0 0 1 2 3\n1 4 5 6 7\n");
  case_["mesh"] = "two.ele";
  case_["sets"] = {{"root", {{"nodes", {0, 1, 2}}}}, {"tip", {{"nodes", {1, 2, 3}}}}};
  EXPECT_THAT(folder_.problem(case_),
              AllOf(HasSubstr("two.ele: tet 1"), HasSubstr("the part of 1 tets"), HasSubstr("0 of 6")));
}

TEST_F(SolveCaseFile, WhatHangsByANodeOrAnEdgeMayNotSwing) {
  case_["mesh"] = "hung.ele";
  const auto hung = [&](const std::string& nodes, const std::string& second, const json& root) {
    write_file(folder_ / "hung.node", nodes);
    write_file(folder_ / "hung.ele", "2 4\n0 0 1 2 3\n1 " + second + "\n");
    case_["sets"] = {{"root", {{"nodes", root}}}, {"tip", {{"nodes", {0, 2, 3}}}}};
  };
  const auto names_second = AllOf(HasSubstr("hung.ele: tet 1"), HasSubstr("by a node or an edge only"));
  const std::string four = "0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
  hung("7 3\n" + four + "4 2 0 0\n5 1 1 0\n6 1 0 1\n", "1 4 5 6", {0, 2, 3});
  EXPECT_THAT(folder_.problem(case_), names_second);
  // Held at one node more it still turns about the line from there to the joint.
  case_["sets"]["root"]["nodes"] = {0, 2, 3, 4};
  EXPECT_THAT(folder_.problem(case_), names_second);
  case_["sets"]["root"]["nodes"] = {0, 2, 3, 4, 5};
  EXPECT_EQ(folder_.load(case_).mesh.mesh.corners.size(), 2U);
  hung("6 3\n" + four + "4 2 1 0\n5 2 1 1\n", "1 4 2 5", {0, 2, 3});
  EXPECT_THAT(folder_.problem(case_), names_second);
  case_["sets"]["root"]["nodes"] = {0, 2, 3, 5};
  EXPECT_EQ(folder_.load(case_).mesh.mesh.corners.size(), 2U);
  // In motion nothing needs to be held.
  case_["sets"]["root"]["nodes"] = {0, 2, 3};
  case_["dynamics"] = "bdf2";
  case_["dt_s"] = 0.01;
  case_["t_end_s"] = 0.1;
  EXPECT_EQ(folder_.load(case_).mesh.mesh.corners.size(), 2U);
}

TEST_F(SolveCaseFile, TetsTurnedInsideOutOrFlatAreNamedWithTheirVolume) {
  const auto with_top = [&](const std::string& z) {
    write_file(folder_ / "one.node", "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 " + z + "\n");
    write_file(folder_ / "one.ele", "1 4\n0 0 1 2 3\n");
    return problem("/mesh", "one.node");
  };
  EXPECT_THAT(with_top("-3"), AllOf(HasSubstr("one.node: tet 0: has the volume -0.5 m^3"), HasSubstr("inverted")));
  EXPECT_THAT(with_top("0"), AllOf(HasSubstr("has the volume 0 m^3"), HasSubstr("flat")));
  EXPECT_THAT(problem("/mesh", "one.stl"), HasSubstr("must be .vtk, .mesh, .node or .ele"));
}

TEST_F(SolveCaseFile, DynamicsNeedTheirTimes) {
  EXPECT_THAT(problem("/dt_s", 0.01), HasSubstr("a static case has no time step"));
  case_["dynamics"] = "bdf2";
  EXPECT_THAT(folder_.problem(case_), HasSubstr("\"dt_s\" is missing"));
  case_["dt_s"] = 0.01;
  EXPECT_THAT(problem("/t_end_s", 0.001), HasSubstr("must be between 0.01"));
  EXPECT_THAT(problem("/t_end_s", 1e6), HasSubstr("must be between"));
  case_["t_end_s"] = 0.1;
  EXPECT_EQ(folder_.load(case_).dynamics, Dynamics::Bdf2);
  EXPECT_THAT(problem("/conditions/1/ramp", 0.1), HasSubstr("only \"activation\" grows with time"));
}

TEST_F(SolveCaseFile, OutputsAreChecked) {
  EXPECT_THAT(problem("/outputs/0/set", "top"), HasSubstr("must be one of all, root, tip"));
  EXPECT_THAT(problem("/outputs/0/quantity", "stretch"), HasSubstr("no fibres to stretch"));
  EXPECT_THAT(problem("/outputs/0/quantity", "energy"), HasSubstr("the energy is that of the whole body"));
}

TEST_F(SolveCaseFile, ElementsGetTheNodesTheyNeed) {
  case_["element"] = "T10";
  const SolveCase quadratic = folder_.load(case_);
  EXPECT_TRUE(quadratic.mesh.mesh.quadratic());
  EXPECT_NEAR(quadratic.loads.nodal_force_N.sum(), 100.0, 1e-12);
  // The file's mid-sides are dropped for T4, and the nodes that only they used.
  geometry::TetFile file;
  file.mesh = quadratic.mesh.mesh;
  geometry::write_vtk(file, folder_ / "q.vtk");
  case_["mesh"] = "q.vtk";
  case_["element"] = "T4";
  const SolveCase linear = folder_.load(case_);
  EXPECT_FALSE(linear.mesh.mesh.quadratic());
  EXPECT_EQ(linear.mesh.mesh.nodes_m.size(), 12U);
  case_["element"] = "T10";
  EXPECT_EQ(folder_.load(case_).mesh.mesh.nodes_m.size(), quadratic.mesh.mesh.nodes_m.size());
}

}  // namespace
}  // namespace myotact::measure
