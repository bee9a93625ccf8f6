#include "prepare/prepare_limb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/recipe/make_limb.h"
#include "prepare/report/html_report.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

using ::testing::HasSubstr;

LimbWork work_on(const testing::SmallLimb& limb, int threads = 1) {
  PrepareSettings settings;
  settings.tets = 120.0;
  settings.threads = threads;
  return make_limb(limb.anatomy, limb.bones, limb.muscles, settings);
}

TEST(PrepareLimb, MakesAMuscleThatHangsOnBothBodiesAndFlexes) {
  LimbWork limb = work_on(testing::small_limb());
  const anatomy::Specimen specimen = prepare_limb(limb);
  EXPECT_EQ(anatomy::find_defect(specimen), "");
  ASSERT_EQ(specimen.muscles.size(), 1u);
  const anatomy::Muscle& rod = specimen.muscles[0];
  EXPECT_GE(std::count(rod.attachments.begin(), rod.attachments.end(), 0), 4);
  EXPECT_GE(std::count(rod.attachments.begin(), rod.attachments.end(), 1), 4);
  EXPECT_EQ(specimen.groups.at(0).flexors, std::vector<int>{0});
  const SurfaceReport& report = limb.muscles[0].report;
  ASSERT_EQ(report.moment_arms_m.size(), 1u);
  EXPECT_NEAR(report.moment_arms_m[0].second, 0.02, 0.003);
  EXPECT_NEAR(geometry::total_volume_m3(rod.tets), report.volume_m3, 0.01 * report.volume_m3);
  EXPECT_NEAR(report.volume_m3 + report.parted_loss_m3, geometry::enclosed_volume_m3(testing::rod_surface({})), 1e-9);
}

TEST(HtmlReport, StandsAloneAndShowsEveryPart) {
  LimbWork limb = work_on(testing::small_limb());
  limb.muscles[0].report.notes.emplace_back("a < b");
  const anatomy::Specimen specimen = prepare_limb(limb);
  const std::string html = html_report(limb, specimen, {"something is wrong"});
  for (const char* part : {"rod", "upper", "something is wrong", "a &lt; b", "dihedral angles", "Stages"}) {
    EXPECT_THAT(html, HasSubstr(part));
  }
  EXPECT_THAT(html, ::testing::Not(HasSubstr("src=\"http")));
  EXPECT_EQ(html, html_report(limb, specimen, {"something is wrong"}));
}

TEST(PrepareLimb, GivesTheSameBitsWithOneAndTwoThreads) {
  LimbWork one = work_on(testing::small_limb(), 1), two = work_on(testing::small_limb(), 2);
  const anatomy::Specimen first = prepare_limb(one), second = prepare_limb(two);
  EXPECT_EQ(first.muscles[0].tets.nodes_m, second.muscles[0].tets.nodes_m);
  EXPECT_EQ(first.muscles[0].tets.corners, second.muscles[0].tets.corners);
  EXPECT_EQ(first.muscles[0].fibres, second.muscles[0].fibres);
  EXPECT_EQ(first.muscles[0].sections_m2, second.muscles[0].sections_m2);
  EXPECT_EQ(first.muscles[0].skin.positions_m, second.muscles[0].skin.positions_m);
}

TEST(PrepareLimb, TellsItsStagesInOrderAndEndsWhole) {
  LimbWork limb = work_on(testing::small_limb());
  std::vector<std::string> stages;
  double whole = 0.0;
  prepare_limb(limb, [&](const Progress& progress) {
    if (stages.empty() || stages.back() != progress.stage) stages.push_back(progress.stage);
    EXPECT_LE(progress.done, progress.parts);
    EXPECT_GE(progress.whole, whole - 1e-12);
    whole = progress.whole;
  });
  EXPECT_THAT(stages, ::testing::ElementsAre("repair", "part", "remesh", "tetrahedralise", "attach", "fibres", "lines",
                                             "skins"));
  EXPECT_NEAR(whole, 1.0, 1e-9);
}

TEST(PrepareLimb, NamesTheMuscleWhoseBonesAreMissing) {
  testing::SmallLimb input = testing::small_limb();
  input.bones.pop_back();
  LimbWork limb = work_on(input);
  try {
    prepare_limb(limb);
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_THAT(error.what(), HasSubstr("rod: attachments"));
  }
}

TEST(MakeLimb, RefusesSurfacesThatTheRecipeDoesNotName) {
  testing::SmallLimb input = testing::small_limb();
  input.muscles[0].key = "stick";
  EXPECT_THROW(work_on(input), Error);
}

}  // namespace
}  // namespace myotact::prepare
