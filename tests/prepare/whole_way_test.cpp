// The whole way for the canine elbow: from the measured sections, and from the full meshes, which are not part of the
// repository (MYOTACT_CANINE_DIR says where they are).

#include <cstdlib>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "prepare/loft/loft.h"
#include "prepare/prepare_limb.h"
#include "prepare/recipe/make_limb.h"
#include "prepare/recipe/read_recipe.h"
#include "prepare/recipe/read_scan.h"

namespace myotact::prepare {
namespace {

/// Moment arms about the elbow in the file pose [m], from the section centrelines of the data set's table. That of the
/// biceps is the radius of the fitted humeral condyle, round which the recipe leads its line: the centreline (7.5 mm)
/// runs through the bone; the table gives 9.4 mm for the published model's sites and 11.0 mm about the model's own
/// joint.
const std::map<std::string, double> kMomentArms_m = {{"biceps_brachii", 11.35e-3},
                                                     {"brachialis", 11.3e-3},
                                                     {"triceps_brachii_long", -32.1e-3},
                                                     {"triceps_brachii_lateral", -21.6e-3},
                                                     {"triceps_brachii_medial", -22.9e-3},
                                                     {"triceps_brachii_accessory", -30.9e-3},
                                                     {"anconeus", -16.2e-3}};
/// The uncertainty of the axis.
constexpr double kMomentArmTolerance_m = 3e-3;

void check_reports(const LimbWork& limb) {
  for (const MuscleWork& muscle : limb.muscles) {
    const SurfaceReport& report = muscle.report;
    ASSERT_EQ(report.moment_arms_m.size(), 1u) << report.key;
    EXPECT_NEAR(report.moment_arms_m[0].second, kMomentArms_m.at(report.key), kMomentArmTolerance_m) << report.key;
    EXPECT_LT(std::abs(report.cage_volume_error), 0.01) << report.key;
    EXPECT_GT(report.tets.smallest_dihedral_deg, 5.0) << report.key;
    EXPECT_LE(report.skin_triangles, 2500) << report.key;
    EXPECT_LE(report.overlap_p95_m, 2e-4) << report.key;
  }
}

PrepareSettings two_threads() {
  PrepareSettings settings;
  settings.threads = 2;
  return settings;
}

TEST(FullScan, BecomesASpecimenWithThePublishedMomentArms) {
  const char* folder = std::getenv("MYOTACT_CANINE_DIR");
  if (!folder) GTEST_SKIP() << "MYOTACT_CANINE_DIR is not set: the full canine meshes are not there";
  const AnatomyData recipe = read_recipe(data_folder() / "assets" / "canine" / "elbow.json");
  const Scan scan = read_scan({std::filesystem::path(folder) / "forelimb_left"}, recipe);
  LimbWork limb = make_limb(recipe, scan.bones, scan.muscles, two_threads());
  EXPECT_EQ(prepare_limb(limb).muscles.size(), kMomentArms_m.size());
  check_reports(limb);
}

LimbWork lofted_limb() {
  const std::filesystem::path folder = data_folder() / "assets" / "canine";
  return make_limb(read_recipe(folder / "elbow.json"), loft_bones(folder / "forelimb.json"),
                   loft_muscles(folder / "forelimb.json"), two_threads());
}

TEST(Loft, BecomesASpecimenWithThePublishedMomentArmsInTheSameBitsTwice) {
  LimbWork one = lofted_limb(), two = lofted_limb();
  const anatomy::Specimen first = prepare_limb(one), second = prepare_limb(two);
  ASSERT_EQ(first.muscles.size(), kMomentArms_m.size());
  check_reports(one);
  for (std::size_t m = 0; m < first.muscles.size(); ++m) {
    EXPECT_EQ(first.muscles[m].tets.nodes_m, second.muscles[m].tets.nodes_m);
    EXPECT_EQ(first.muscles[m].tets.corners, second.muscles[m].tets.corners);
    EXPECT_EQ(first.muscles[m].fibres, second.muscles[m].fibres);
    EXPECT_EQ(first.muscles[m].skin.positions_m, second.muscles[m].skin.positions_m);
  }
}

}  // namespace
}  // namespace myotact::prepare
