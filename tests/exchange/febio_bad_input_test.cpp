// What cannot be read is said with its line, all of it at once.

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "exchange/febio_cube.h"
#include "exchange/febio_read.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::exchange {
namespace {

using myotact::testing::FebioCube;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string problem(const std::string& text) {
  return myotact::testing::complaint(ExitStatus::BadData, [&] { parse_febio(text, "cube.feb"); });
}
std::string problem(const FebioCube& cube) {
  return problem(cube.text());
}

TEST(FebioInput, OtherVersionsAreRefusedWithARemedy) {
  for (const char* version : {"2.5", "3.0", ""}) {
    FebioCube cube;
    cube.version = version;
    EXPECT_THAT(problem(cube), AllOf(HasSubstr("cube.feb: line 2: <febio_spec>"), HasSubstr("export it as 4.0")));
  }
  FebioCube fluid;
  fluid.module = "fluid";
  EXPECT_THAT(problem(fluid), HasSubstr("must be \"solid\""));
  EXPECT_THAT(problem("<opensim/>"), HasSubstr("no FEBio model"));
}

TEST(FebioInput, TruncatedFilesAreRefused) {
  const std::string whole = FebioCube().text();
  for (std::size_t length = 0; length + 15 < whole.size(); length += 37) problem(whole.substr(0, length));
  EXPECT_THAT(problem(whole.substr(0, whole.size() / 2)), HasSubstr("line "));
}

TEST(FebioInput, UnknownElementsAreListedTogether) {
  FebioCube cube;
  cube.elements += R"(<Elements type="penta6" name="wedge"/><Elements type="tri3" name="shell"/>)";
  cube.sections =
      R"(<Contact><contact type="sliding-elastic"/></Contact><Rigid><rigid_bc type="rigid_fixed"/></Rigid>)";
  EXPECT_THAT(problem(cube), AllOf(HasSubstr("penta6"), HasSubstr("tri3"), HasSubstr("<Contact>"), HasSubstr("<Rigid>"),
                                   HasSubstr("tet4, tet10 and hex8")));
  FebioCube other;
  other.boundary = R"(<bc type="rigid deformation" node_set="x1"/>)";
  other.loads = R"(<surface_load type="fluidflux" surface="end"/><body_load type="centrifugal"/>)";
  EXPECT_THAT(problem(other), AllOf(HasSubstr("rigid deformation"), HasSubstr("fluidflux"), HasSubstr("centrifugal")));
}

TEST(FebioInput, UnknownMaterialsAreNamed) {
  FebioCube cube;
  cube.material = R"(<material id="1" name="stuff" type="solid mixture"><solid type="Ogden"/>
    <solid type="neo-Hookean"><E>1</E><v>0.3</v><mat_axis type="local">1,2,3</mat_axis></solid></material>)";
  EXPECT_THAT(problem(cube), AllOf(HasSubstr("\"Ogden\""), HasSubstr("\"local\"")));
  cube.material = R"(<material id="1" name="stuff" type="hyperelastic"><W>2*(I1-3)+exp(J)</W></material>)";
  EXPECT_THAT(problem(cube), HasSubstr("not that of a stable neo-Hookean"));
  cube.material = R"(<material id="1" name="stuff" type="solid mixture"><solid type="active fiber stress"
    name="active muscle_fibre degroote_fregly_2016 rest_length=1 gain=1"><smax>1</smax><activation>1</activation>
    <stl type="point"><points><pt>1,1</pt></points></stl></solid></material>)";
  EXPECT_THAT(problem(cube), HasSubstr("that its name does not describe"));
  cube.material = R"(<material id="1" name="stuff" type="Mooney-Rivlin"><c1>1</c1><k>9</k>
    <pressure_model>2</pressure_model></material>)";
  EXPECT_THAT(problem(cube), HasSubstr("<pressure_model>"));
  cube.material =
      R"(<material id="1" name="stuff" type="prescribed isotropic active contraction"><T0>1</T0></material>)";
  EXPECT_THAT(problem(cube), HasSubstr("resists shear"));
}

TEST(FebioInput, MissingReferencesAreNamed) {
  FebioCube cube;
  cube.boundary = R"(<bc type="zero displacement" node_set="nowhere"><x_dof>1</x_dof></bc>)";
  EXPECT_THAT(problem(cube), HasSubstr("\"nowhere\""));
  cube.boundary = R"(<bc type="prescribed displacement" node_set="x1"><dof>x</dof><value lc="7">1</value></bc>)";
  EXPECT_THAT(problem(cube), HasSubstr("load controller \"7\""));
  cube.boundary = R"(<bc type="prescribed displacement" node_set="x1"><dof>x</dof><value type="map">no</value></bc>)";
  EXPECT_THAT(problem(cube), HasSubstr("data \"no\""));
  cube.boundary = R"(<bc type="zero displacement" node_set="@surface:none"><x_dof>1</x_dof></bc>)";
  EXPECT_THAT(problem(cube), HasSubstr("surface \"none\""));
  cube.boundary.clear();
  cube.elements = R"(<Elements type="hex8" name="cube"><elem id="9">11,12,13,14,15,16,17,99</elem></Elements>)";
  EXPECT_THAT(problem(cube), HasSubstr("node 99"));
  cube.elements = R"(<Elements type="hex8" name="other"><elem id="9">11,12,13,14,15,16,17,18</elem></Elements>)";
  EXPECT_THAT(problem(cube), HasSubstr("no <SolidDomain>"));
}

TEST(FebioInput, NumbersAreFiniteAndInRange) {
  FebioCube cube;
  for (const char* young : {"nan", "inf", "1e999", "-1", "0", "", "1,2", "one"}) {
    cube.material =
        fmt::format(R"(<material id="1" name="stuff" type="neo-Hookean"><E>{}</E><v>0.3</v></material>)", young);
    EXPECT_THAT(problem(cube), HasSubstr("<E>")) << young;
  }
  cube.material = R"(<material id="1" name="stuff" type="neo-Hookean"><E>1</E><v>0.5</v></material>)";
  EXPECT_THAT(problem(cube), HasSubstr("< 0.5"));
  cube = FebioCube();
  cube.elements = R"(<Elements type="tet4" name="cube"><elem id="9">11,12,13,14.5</elem></Elements>)";
  EXPECT_THAT(problem(cube), HasSubstr("whole number"));
  cube.elements = R"(<Elements type="tet4" name="cube"><elem id="9">11,13,12,15</elem></Elements>)";
  EXPECT_THAT(problem(cube), HasSubstr("inverted"));
  cube.elements = R"(<Elements type="tet4" name="cube"><elem id="9">11,12,13</elem></Elements>)";
  EXPECT_THAT(problem(cube), HasSubstr("must hold 4"));
  cube = FebioCube();
  cube.curve = "<pt>1,0</pt><pt>0,1</pt>";
  EXPECT_THAT(problem(cube), HasSubstr("times must rise"));
}

/// Entities are never expanded, so that nine lines cannot become gigabytes.
TEST(FebioInput, EntityBombsStaySmall) {
  std::string bomb = "<?xml version=\"1.0\"?>\n<!DOCTYPE febio_spec [\n<!ENTITY a \"1\">\n";
  for (char name = 'b'; name <= 'k'; ++name) {
    bomb += fmt::format("<!ENTITY {} \"", name);
    for (int k = 0; k < 10; ++k) bomb += fmt::format("&{};", static_cast<char>(name - 1));
    bomb += "\">\n";
  }
  FebioCube cube;
  cube.material = R"(<material id="1" name="stuff" type="neo-Hookean"><E>&k;</E><v>0.3</v></material>)";
  const std::string text = cube.text();
  EXPECT_THAT(problem(bomb + "]>\n" + text.substr(text.find('\n') + 1)), HasSubstr("\"&k;\""));
}

TEST(FebioInput, HugeAndMissingFilesAreRefused) {
  const myotact::testing::TemporaryFolder folder;
  const auto file = folder / "huge.feb";
  std::ofstream(file) << "<febio_spec";
  std::filesystem::resize_file(file, std::uintmax_t{1} << 29);  // sparse
  const auto read = [](const std::filesystem::path& path) { read_febio(path); };
  EXPECT_THAT(myotact::testing::complaint(ExitStatus::BadData, [&] { read(file); }), HasSubstr("512 MB"));
  myotact::testing::complaint(ExitStatus::NoInput, [&] { read(folder / "none.feb"); });
}

TEST(FebioInput, ASecondStepAndOtherDrivesAreRefused) {
  FebioCube cube;
  cube.sections = R"(<Step><step id="1"/><step id="2"/></Step>)";
  EXPECT_THAT(problem(cube), HasSubstr("one step is read"));
  cube = FebioCube();
  cube.loads =
      R"(<surface_load type="traction" surface="end"><traction>1,0,0</traction><linear>0</linear></surface_load>)";
  EXPECT_THAT(problem(cube), HasSubstr("linear 1"));
}

TEST(FebioInput, ABodyThatNothingHoldsIsRefused) {
  std::string text = FebioCube().text();
  text.erase(text.find("<bc name=\"b\""), text.find("<bc name=\"c\"") - text.find("<bc name=\"b\""));
  EXPECT_THAT(problem(text), HasSubstr("rigid body"));
}

}  // namespace
}  // namespace myotact::exchange
