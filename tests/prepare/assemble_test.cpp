#include "prepare/assemble.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

using ::testing::HasSubstr;

PreparedInput small_input() {
  const testing::SmallLimb limb = testing::small_limb();
  return {limb.anatomy, limb.bones, limb.muscles};
}

const PrepareSettings kCoarse{80.0};

TEST(AssembleSpecimen, MakesAMuscleThatHangsOnBothBodiesAndFlexes) {
  std::vector<SurfaceReport> reports;
  const anatomy::Specimen specimen = assemble_specimen(small_input(), kCoarse, reports);
  EXPECT_EQ(anatomy::find_defect(specimen), "");
  ASSERT_EQ(specimen.muscles.size(), 1u);
  const anatomy::Muscle& rod = specimen.muscles[0];
  EXPECT_GE(std::count(rod.attachments.begin(), rod.attachments.end(), 0), 4);
  EXPECT_GE(std::count(rod.attachments.begin(), rod.attachments.end(), 1), 4);
  EXPECT_EQ(specimen.groups.at(0).flexors, std::vector<int>{0});
  ASSERT_EQ(reports.size(), 3u);
  ASSERT_EQ(reports[2].levers_m.size(), 1u);
  EXPECT_NEAR(reports[2].levers_m[0].second, 0.02, 0.003);
  const double volume_m3 = geometry::total_volume_m3(rod.tets);
  EXPECT_NEAR(volume_m3, reports[2].volume_m3, 0.01 * reports[2].volume_m3);
}

TEST(AssembleSpecimen, GivesTheSameBitsTwice) {
  std::vector<SurfaceReport> reports;
  const anatomy::Specimen first = assemble_specimen(small_input(), kCoarse, reports);
  const anatomy::Specimen second = assemble_specimen(small_input(), kCoarse, reports);
  EXPECT_EQ(first.muscles[0].tets.nodes_m, second.muscles[0].tets.nodes_m);
  EXPECT_EQ(first.muscles[0].tets.corners, second.muscles[0].tets.corners);
  EXPECT_EQ(first.muscles[0].fibres, second.muscles[0].fibres);
  EXPECT_EQ(first.muscles[0].sections_m2, second.muscles[0].sections_m2);
  EXPECT_EQ(first.muscles[0].skin.positions_m, second.muscles[0].skin.positions_m);
}

TEST(AssembleSpecimen, NamesTheMuscleWhoseBonesAreMissing) {
  PreparedInput input = small_input();
  input.bones.pop_back();
  std::vector<SurfaceReport> reports;
  try {
    assemble_specimen(input, kCoarse, reports);
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_THAT(error.what(), HasSubstr("rod: attachments"));
  }
}

TEST(AssembleSpecimen, RefusesSurfacesThatTheAnatomyDoesNotName) {
  PreparedInput input = small_input();
  input.muscles[0].key = "stick";
  std::vector<SurfaceReport> reports;
  EXPECT_THROW(assemble_specimen(input, kCoarse, reports), Error);
}

}  // namespace
}  // namespace myotact::prepare
