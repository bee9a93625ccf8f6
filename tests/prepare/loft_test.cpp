#include "prepare/loft/loft.h"

#include <map>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/triangle_mesh.h"
#include "prepare/recipe/read_recipe.h"
#include "support/source_folder.h"

namespace myotact::prepare {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(source_folder()) / "assets" / "canine";
const std::filesystem::path kForelimb = kAssets / "forelimb.json", kHindlimb = kAssets / "hindlimb.json";

/// Volumes of the measured meshes [cm^3]. Ellipses and eight harmonics lose grooves and slips: 10 % are allowed.
const std::map<std::string, double> kMeasured_cm3 = {{"biceps_brachii", 29.6},
                                                     {"brachialis", 8.7},
                                                     {"triceps_brachii_long", 97.8},
                                                     {"triceps_brachii_lateral", 81.3},
                                                     {"triceps_brachii_medial", 31.6},
                                                     {"triceps_brachii_accessory", 17.3},
                                                     {"anconeus", 2.2},
                                                     {"scapula", 81.3},
                                                     {"humerus", 57.4},
                                                     {"radius", 30.1},
                                                     {"ulna", 27.0}};

void expect_sound(const std::vector<NamedSurface>& surfaces, int& measured) {
  for (const NamedSurface& surface : surfaces) {
    EXPECT_EQ(geometry::bad_edge_count(surface.surface), 0) << surface.key;
    const double volume_cm3 = 1e6 * geometry::enclosed_volume_m3(surface.surface);
    EXPECT_GT(volume_cm3, 0.0) << surface.key;
    const auto known = kMeasured_cm3.find(surface.key);
    if (known == kMeasured_cm3.end()) continue;
    ++measured;
    EXPECT_NEAR(volume_cm3 / known->second, 1.0, 0.1) << surface.key;
  }
}

TEST(Loft, IsClosedOutwardAndAsLargeAsTheMeasuredMesh) {
  int measured = 0;
  expect_sound(loft_muscles(kForelimb), measured);
  expect_sound(loft_bones(kForelimb), measured);
  EXPECT_EQ(measured, 11);
}

TEST(Loft, GivesTheSameBitsTwice) {
  const auto once = loft_muscles(kForelimb);
  const auto twice = loft_muscles(kForelimb);
  for (std::size_t m = 0; m < once.size(); ++m) {
    EXPECT_EQ(once[m].surface.positions_m, twice[m].surface.positions_m) << once[m].key;
  }
}

TEST(Loft, KnowsTheMiddleOfTheSectionsFromTipToTip) {
  for (const NamedSurface& muscle : loft_muscles(kHindlimb)) {
    ASSERT_GE(muscle.middle_m.size(), 4u) << muscle.key;
    if (muscle.key != "biceps_femoris") continue;
    EXPECT_EQ(muscle.middle_m.front(), Vec3(-0.3416, 0.0324, 0.4914));
    EXPECT_EQ(muscle.middle_m.back(), Vec3(-0.3928, 0.0980, 0.2587));
  }
}

TEST(AnatomyAssets, ElbowFlexesByARightHandRotationOfTheForearm) {
  const AnatomyData data = read_recipe(kForelimb);
  EXPECT_EQ(data.muscles.size(), 33u);
  for (const auto& joint : data.joints) {
    if (joint.key != "elbow") continue;
    // The paw lies below the elbow; flexion carries it cranially (+x).
    const Vec3 below(0.0, 0.0, -1.0);
    EXPECT_GT(joint.axes[0].cross(below).x(), 0.9);
    EXPECT_LT(joint.range_rad[0].first, 0.0);
    return;
  }
  FAIL() << "no elbow";
}

TEST(AnatomyAssets, NameEveryMuscleOfTheHindlimbAndTheLigamentToBuild) {
  const AnatomyData data = read_recipe(kHindlimb);
  EXPECT_EQ(data.muscles.size(), 35u);
  ASSERT_EQ(data.built.size(), 1u);
  EXPECT_NEAR((data.built[0].ends_m[1] - data.built[0].ends_m[0]).norm(), 0.041, 0.001);  // measured
  EXPECT_EQ(data.leave_out.size(), 2u);
}

}  // namespace
}  // namespace myotact::prepare
