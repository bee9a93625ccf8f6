#include "prepare/check/specimen_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/data_folder.h"

namespace myotact::prepare {
namespace {

TEST(SpecimenCheck, FindsNothingWrongWithTheEmbeddedLimbs) {
  for (const char* limb : {"canine_forelimb", "canine_hindlimb"}) {
    EXPECT_THAT(find_violations(anatomy::load_specimen(data_folder() / "meshes" / limb)), ::testing::IsEmpty());
  }
}

TEST(SpecimenCheck, NamesOverlapsThatAreNotListed) {
  anatomy::Specimen limb = anatomy::load_specimen(data_folder() / "meshes" / "canine_hindlimb");
  ASSERT_FALSE(limb.overlaps.empty());
  limb.overlaps.clear();
  EXPECT_THAT(find_violations(limb), ::testing::Contains(::testing::HasSubstr("extensor_digitorum_longus and femur")));
}

}  // namespace
}  // namespace myotact::prepare
