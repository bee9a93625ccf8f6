#include "view/overlay/opposing_pulls.h"

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

/// Statics of a hinge: of equal and opposite groups the forces add up, and their torques about it cancel.
TEST(OpposingPulls, OfEqualOpponentsAddUpAndTurnNothing) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  messages::SceneFrame frame = testing::frame_at_rest(specimen);
  for (double& tension_N : frame.tensions_N) tension_N = 40.0;
  ASSERT_EQ(frame.joints[0].muscles.size(), 2u);
  frame.joints[0].muscles[0].torque_Nm = 1.0;
  frame.joints[0].muscles[1].torque_Nm = -1.0;
  const auto [flexors, extensors] = opposing_pulls(specimen, frame, 0);
  EXPECT_NEAR(glm::length(flexors.force_N), 40.0f, 1e-3f);
  EXPECT_LT(glm::distance(flexors.force_N, extensors.force_N), 1e-3f);
  const glm::vec3 centre_m(static_cast<float>(specimen.joints[0].centre_m.x()),
                           static_cast<float>(specimen.joints[0].centre_m.y()),
                           static_cast<float>(specimen.joints[0].centre_m.z()));
  const glm::vec3 turn_Nm = glm::cross(flexors.place_m - centre_m, flexors.force_N) +
                            glm::cross(extensors.place_m - centre_m, extensors.force_N);
  EXPECT_LT(glm::length(turn_Nm), 1e-4f);
  EXPECT_GT(glm::length(glm::cross(flexors.place_m - centre_m, flexors.force_N)), 0.1f);
  EXPECT_EQ(flexors.full_N, static_cast<float>(specimen.muscles[0].peak_force_N));
}

TEST(OpposingPulls, AreNoneWithoutAJointOrATorque) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  const messages::SceneFrame frame = testing::frame_at_rest(specimen);
  for (const int joint : {-1, 0, 7}) {
    for (const GroupPull& group : opposing_pulls(specimen, frame, joint)) {
      EXPECT_EQ(group.force_N, glm::vec3(0.0f));
      EXPECT_EQ(group.place_m, glm::vec3(0.0f));
    }
  }
}

}  // namespace
}  // namespace myotact::view
