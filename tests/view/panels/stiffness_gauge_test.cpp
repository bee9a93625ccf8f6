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

}  // namespace
}  // namespace myotact::view
