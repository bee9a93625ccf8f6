#include "prepare/check/specimen_check.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/data_folder.h"

namespace myotact::prepare {
namespace {

std::vector<std::string> violations_of(const char* limb) {
  return find_violations(anatomy::load_specimen(data_folder() / "meshes" / limb));
}

/// Two small muscles that are enclosed all round gave way by 4 % of their skins' volume, and the long digital extensor
/// passes through the groove of the femur.
TEST(SpecimenCheck, NamesWhatTheEmbeddedLimbsFallShortOfAndNoMore) {
  using ::testing::ElementsAre;
  using ::testing::HasSubstr;
  EXPECT_THAT(violations_of("canine_forelimb"),
              ElementsAre(HasSubstr("anconeus.vtk: holds"), HasSubstr("supinator.vtk: holds")));
  EXPECT_THAT(violations_of("canine_hindlimb"), ElementsAre());
}

TEST(SpecimenCheck, NamesOverlapsThatAreNotListed) {
  anatomy::Specimen limb = anatomy::load_specimen(data_folder() / "meshes" / "canine_hindlimb");
  ASSERT_EQ(limb.muscles[0].key, "rectus_femoris");
  for (Vec3& p : limb.muscles[0].skin.positions_m) p.x() -= 0.004;  // caudad, into the vasti
  EXPECT_THAT(find_violations(limb), ::testing::Contains(::testing::HasSubstr("rectus_femoris and vastus_")));
}

}  // namespace
}  // namespace myotact::prepare
