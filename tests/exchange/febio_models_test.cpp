// Models as FEBio takes them, solved here, beside FEBio's own answers: norms of all free displacements in its test
// suite (febiosoftware/TestSuite, linuxGoldStandards.py), of models that are uniform, so that a hexahedron cut into
// tets is the same; and beside closed forms.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exchange/febio_cube.h"
#include "exchange/febio_read.h"
#include "measure/solve_answer.h"

namespace myotact::exchange {
namespace {

using myotact::testing::FebioCube;

/// An output of the solved model.
std::vector<double> solved(const FebioCube& cube, const std::string& name) {
  const measure::SolveAnswer answer =
      measure::solve_case(parse_febio(cube.text(), "cube.feb").solve_case, [](const auto&) {});
  EXPECT_TRUE(answer.converged);
  for (const auto& [output, values] : answer.outputs) {
    if (output.name == name) return values;
  }
  ADD_FAILURE() << name;
  return {0.0, 0.0, 0.0};
}

double norm_of(const FebioCube& cube) {
  return solved(cube, "all.displacement.l2")[0];
}

TEST(FebioModels, UniaxialContractionOfANeoHookeanCube) {  // ma24
  FebioCube cube;
  cube.material = R"(<material id="1" name="stuff" type="solid mixture"><density>1</density>
    <solid type="neo-Hookean"><E>1</E><v>0.3</v></solid>
    <solid type="prescribed uniaxial active contraction"><T0 lc="1">0.5</T0>
      <mat_axis type="angles"><theta>0</theta><phi>90</phi></mat_axis></solid></material>)";
  EXPECT_NEAR(norm_of(cube), 0.61766348475, 1e-8);
}

TEST(FebioModels, IsotropicContractionOfANeoHookeanCube) {  // ma20
  FebioCube cube;
  cube.material = R"(<material id="1" name="stuff" type="solid mixture">
    <solid type="neo-Hookean"><E>1</E><v>0.3</v></solid>
    <solid type="prescribed isotropic active contraction"><T0 lc="1">0.5</T0></solid></material>)";
  EXPECT_NEAR(norm_of(cube), 0.493408719039, 1e-8);
}

TEST(FebioModels, MuscleMaterialStretchedByATable) {  // mu03: four nodes are moved by 0.2
  FebioCube cube;
  cube.material = R"(<material id="1" name="stuff" type="muscle material"><k>1e+07</k>
    <pressure_model>default</pressure_model><g1>500</g1><g2>500</g2><g3>0</g3><p1>0.05</p1><p2>6.6</p2><Lofl>1</Lofl>
    <smax>300000</smax><lam_max>1.4</lam_max><activation>0</activation>
    <fiber type="vector"><vector>1,0,0</vector></fiber></material>)";
  cube.mesh_data = R"(<NodeData name="way" node_set="x1" data_type="scalar"><node lid="1">1</node><node lid="2">1</node>
    <node lid="3">1</node><node lid="4">1</node></NodeData>)";
  cube.boundary = R"(<bc name="moved" node_set="x1" type="prescribed displacement"><dof>x</dof>
    <value lc="1" type="map">way</value><relative>0</relative></bc>)";
  cube.curve = "<pt>0,0</pt><pt>1,0.2</pt>";
  EXPECT_NEAR(std::sqrt(std::pow(norm_of(cube), 2) - 4.0 * 0.2 * 0.2), 0.244325959214, 1e-6);
}

/// Its calcium tension takes the volume ratio for 1, which is 0.2 % off here (febio_laws.h). One of ten cubes.
TEST(FebioModels, CalciumDrivenContraction) {  // fi01
  FebioCube cube;
  cube.material = R"(<material id="1" name="stuff" type="trans iso Mooney-Rivlin"><k>100</k><c1>1</c1><c2>0</c2>
    <c3>1</c3><c4>1</c4><c5>1</c5><lam_max>10</lam_max>
    <fiber type="vector"><vector>1,0,0</vector></fiber><active_contraction><ascl lc="1">1</ascl><Tmax>1</Tmax>
    <ca0>4.75</ca0><camax>0</camax><beta>4.35</beta><l0>1.58</l0><refl>2.04</refl></active_contraction></material>)";
  // Closed form of the gold standard's state: stretch 0.891875, across 1.057741 (tests/validation/febio_fi01.json).
  const double along = 1.0 - 0.891875, across = 0.057741;
  EXPECT_NEAR(norm_of(cube), 2.0 * std::sqrt(along * along + 2.0 * across * across), 2e-3 * 2.0 * along);
}

/// sigma = mu (l^2 - 1)/l ... at Poisson's ratio 0: lambda = 0, sigma_x = mu (l - 1/l) per area at rest.
TEST(FebioModels, ForcesPressureAndTractionPullAlike) {
  FebioCube cube;
  cube.material = R"(<material id="1" name="stuff" type="neo-Hookean"><E>2</E><v>0</v></material>)";
  cube.more_mesh = R"(<Surface name="end"><quad4 id="1">12,13,17,16</quad4></Surface>)";
  const double stretch = 1.1, nominal_Pa = stretch - 1.0 / stretch;
  cube.loads =
      fmt::format(R"(<nodal_load name="f" node_set="x1" type="nodal_force"><value lc="1">{},0,0</value></nodal_load>)",
                  0.25 * nominal_Pa);
  FebioCube dragged = cube, pressed = cube;
  dragged.loads = fmt::format(R"(<surface_load surface="end" type="traction"><scale lc="1">{}</scale>
    <traction>1,0,0</traction></surface_load>)",
                              nominal_Pa);
  pressed.loads = fmt::format(R"(<surface_load surface="end" type="pressure"><pressure lc="1">{}</pressure>
    <linear>0</linear></surface_load>)",
                              -nominal_Pa);
  for (const FebioCube& one : {dragged, pressed}) {  // nu = 0: the area stays
    EXPECT_NEAR(solved(one, "all.displacement.max")[0], stretch - 1.0, 1e-7);
  }
  // Forces at corners only do not spread evenly over quadratic tets; their sum is right.
  EXPECT_NEAR(solved(cube, "a.reaction.sum")[0], -nominal_Pa, 1e-9);
}

TEST(FebioModels, BodyForcesAreSubtracted) {
  FebioCube cube;
  cube.material =
      R"(<material id="1" name="stuff" type="neo-Hookean"><density>2</density><E>1e6</E><v>0</v></material>)";
  cube.loads = R"(<body_load type="body force"><force lc="1">3,0,0</force></body_load>)";
  EXPECT_NEAR(solved(cube, "a.reaction.sum")[0], 6.0, 1e-9);  // 2 kg pulled to -x
}

TEST(FebioModels, FibresByElementAxesAndByMaterialAgree) {
  FebioCube cube;
  cube.material = R"(<material id="1" name="stuff" type="coupled trans-iso Mooney-Rivlin"><c1>1</c1><c2>0</c2><c3>2</c3>
    <c4>5</c4><c5>20</c5><lam_max>1.2</lam_max><k>3</k><fiber type="vector"><vector>0,1,0</vector></fiber></material>)";
  cube.loads = R"(<nodal_load node_set="x1" type="nodal_force"><value lc="1">0.1,0,0</value></nodal_load>)";
  FebioCube axes = cube;  // the second axis of the tets is y again
  axes.mesh_data =
      R"(<ElementData type="mat_axis" elem_set="cube"><elem lid="1"><a>0,0,2</a><d>0,1,0</d></elem></ElementData>)";
  FebioCube turned = cube;
  turned.mesh_data = R"(<ElementData type="fiber" elem_set="cube"><elem lid="1">0,3,0</elem></ElementData>)";
  EXPECT_NEAR(norm_of(axes), norm_of(cube), 1e-9);
  EXPECT_NEAR(norm_of(turned), norm_of(cube), 1e-9);
}

TEST(FebioModels, WhatChangesNoAnswerIsListed) {
  FebioCube cube;
  cube.loads = R"(<nodal_load node_set="x1" type="nodal_force"><value lc="1">0.1,0,0</value></nodal_load>)";
  cube.sections = "<Globals><Constants><T>0</T></Constants></Globals>";
  EXPECT_THAT(parse_febio(cube.text(), "cube.feb").left_out,
              ::testing::ElementsAre(::testing::HasSubstr("<Output>"), ::testing::HasSubstr("<Globals>")));
}

TEST(FebioModels, OneStepIsRead) {
  FebioCube cube;
  cube.sections = R"(<Step><step id="1"><Boundary><bc name="m" node_set="x1" type="prescribed displacement"><dof>x</dof>
    <value lc="1">0.1</value></bc></Boundary></step></Step>)";
  EXPECT_NEAR(solved(cube, "m.displacement.mean")[0], 0.1, 1e-12);
}

}  // namespace
}  // namespace myotact::exchange
