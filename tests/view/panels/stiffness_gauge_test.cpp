#include "view/panels/stiffness_gauge.h"

#include <limits>

#include <gtest/gtest.h>

namespace myotact::view {
namespace {

TEST(StiffnessGauge, PartsTheTorquesByWhereTheyTurnTheJoint) {
  messages::JointFrame joint;
  for (const double torque_Nm : {0.4, -0.3, 0.2, -0.25, 0.0}) joint.muscles.push_back({torque_Nm});
  const OpposingTorques sides = opposing_torques(joint);
  EXPECT_DOUBLE_EQ(sides.flexing_Nm, 0.6);
  EXPECT_DOUBLE_EQ(sides.extending_Nm, -0.55);
}

TEST(StiffnessGauge, ItsScaleEndsAtNumbersThatAreEasyToRead) {
  EXPECT_EQ(scale_end(0.0), 1.0);
  EXPECT_EQ(scale_end(1.0), 1.0);
  EXPECT_EQ(scale_end(1.01), 2.0);
  EXPECT_EQ(scale_end(2.2), 5.0);
  EXPECT_EQ(scale_end(7.7), 10.0);
  EXPECT_EQ(scale_end(12.0), 20.0);
  EXPECT_EQ(scale_end(-3.0), 1.0);
  EXPECT_EQ(scale_end(std::numeric_limits<double>::quiet_NaN()), 1.0);
  EXPECT_EQ(scale_end(std::numeric_limits<double>::infinity()), 1.0);
}

TEST(StiffnessGauge, KeepsTwentySecondsAndBeginsAnewWithTheScene) {
  StiffnessGauge gauge;
  for (int picture = 0; picture < 4000; ++picture) gauge.note(0.01 * picture, 1.0 + picture);
  EXPECT_LE(gauge.history().size(), 501u);
  EXPECT_NEAR(gauge.history().back().time_s, 39.99, 0.05);
  EXPECT_NEAR(gauge.history().front().time_s, 20.0, 0.1);
  gauge.note(40.0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_LT(gauge.history().back().time_s, 40.0) << "what is not known is not drawn";
  gauge.note(0.01, 2.0);
  ASSERT_EQ(gauge.history().size(), 1u);
  EXPECT_EQ(gauge.history().front().K_Nm_rad, 2.0);
}

}  // namespace
}  // namespace myotact::view
