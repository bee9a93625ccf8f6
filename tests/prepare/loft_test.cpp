#include "prepare/loft/loft.h"

#include <map>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/triangle_mesh.h"
#include "prepare/recipe/anatomy_assets.h"

namespace myotact::prepare {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(MYOTACT_SOURCE_DIR) / "assets" / "canine";

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
  expect_sound(loft_muscles(kAssets), measured);
  expect_sound(loft_bones(kAssets), measured);
  EXPECT_EQ(measured, 11);
}

TEST(Loft, GivesTheSameBitsTwice) {
  const auto once = loft_muscles(kAssets);
  const auto twice = loft_muscles(kAssets);
  for (std::size_t m = 0; m < once.size(); ++m) {
    EXPECT_EQ(once[m].surface.positions_m, twice[m].surface.positions_m) << once[m].key;
  }
}

TEST(AnatomyAssets, ElbowFlexesByARightHandRotationOfTheForearm) {
  const AnatomyData data = read_anatomy(kAssets);
  ASSERT_EQ(data.muscles.size(), 7u);
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

}  // namespace
}  // namespace myotact::prepare
