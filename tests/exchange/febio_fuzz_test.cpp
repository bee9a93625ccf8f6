#include <gtest/gtest.h>

#include "exchange/febio_cube.h"
#include "exchange/febio_read.h"
#include "support/mutator.h"

// Broken bytes never crash the reader of FEBio's models: each gives a case or an Error that says what is wrong.

namespace myotact::exchange {
namespace {

TEST(FebioFuzz, BrokenModelsAreReadOrRefused) {
  constexpr int kRounds = 3000;  // a second or two
  myotact::testing::FebioCube cube;
  cube.material = R"(<material id="1" name="stuff" type="solid mixture"><solid type="hyperelastic">
    <W>2*(I1-3)-2*ln(I1+1)+5*(J-1.2)^2</W></solid><solid type="prescribed uniaxial active contraction"><T0 lc="1">0.5</T0>
    </solid><solid type="muscle material"><k>9</k><g1>1</g1><g2>1</g2><p1>0.05</p1><p2>6.6</p2><Lofl>1</Lofl><smax>3</smax>
    <lam_max>1.4</lam_max><activation>0.5</activation></solid></material>)";
  cube.more_mesh = R"(<Surface name="end"><quad4 id="1">12,13,17,16</quad4></Surface>)";
  cube.mesh_data =
      R"(<ElementData type="mat_axis" elem_set="cube"><elem lid="1"><a>0,0,2</a><d>0,1,0</d></elem></ElementData>
    <NodeData name="way" node_set="x1"><node lid="1">1</node></NodeData>)";
  cube.boundary =
      R"(<bc name="m" node_set="x1" type="prescribed displacement"><dof>y</dof><value type="map">way</value></bc>)";
  cube.loads = R"(<surface_load surface="end" type="pressure"><pressure lc="1">1</pressure></surface_load>
    <body_load type="body force"><force>1,2,3</force></body_load>)";
  const std::string whole = cube.text();
  myotact::testing::Mutator mutator;
  int refused = 0;
  for (int round = 0; round < kRounds; ++round) {
    try {
      EXPECT_FALSE(parse_febio(mutator.broken(whole), "cube.feb").solve_case.mesh.mesh.corners.empty());
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(error.status(), ExitStatus::BadData) << error.what();
      EXPECT_TRUE(std::string(error.what()).starts_with("cube.feb")) << error.what();
    }
  }
  EXPECT_GT(refused, kRounds / 2);
}

}  // namespace
}  // namespace myotact::exchange
