#include "prepare/recipe/units_and_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

using ::testing::HasSubstr;

/// The small limb's recipe, and a scan of it with a bone that reaches far beyond the muscle.
struct ScannedLimb {
  testing::SmallLimb limb = testing::small_limb();
  Scan scan{limb.bones, limb.muscles, {}};

  explicit ScannedLimb(double scale, double mirror = 1.0) {
    scan.bones.push_back({"foot", testing::box_surface({0.5, -0.02, -0.02}, {0.6, 0.02, 0.02})});
    for (auto* parts : {&scan.bones, &scan.muscles}) {
      for (NamedSurface& part : *parts) {
        for (Vec3& p : part.surface.positions_m) p = scale * p.cwiseProduct(Vec3(1.0, mirror, 1.0));
      }
    }
  }
};

TEST(UnitsAndFrame, AreGuessedFromTheMusclesWhateverElseIsInTheScan) {
  for (const auto& [unit, scale] : {std::pair{"m", 1.0}, std::pair{"cm", 100.0}, std::pair{"mm", 1000.0}}) {
    ScannedLimb scanned(scale);
    set_units_and_frame(scanned.scan, scanned.limb.anatomy, "");
    EXPECT_THAT(scanned.scan.notes.back(), HasSubstr(std::string("taken as ") + unit));
    EXPECT_NEAR(scanned.scan.muscles[0].surface.positions_m[0].norm(),
                scanned.limb.muscles[0].surface.positions_m[0].norm(), 1e-9);
  }
}

TEST(UnitsAndFrame, RefusesADogOfFiveMillimetresOrFiftyMetres) {
  for (const double scale : {0.005, 80.0 * 1000.0}) {
    ScannedLimb scanned(scale);
    EXPECT_THROW(set_units_and_frame(scanned.scan, scanned.limb.anatomy, ""), Error) << scale;
  }
}

}  // namespace
}  // namespace myotact::prepare
