#include "haptics/gate/stiffness_bound.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myotact::haptics {
namespace {

// (0.2 + 4) N s/m over (T/2 + delay): frictionless ideal (b 0.2) in a hand of 4 N s/m at 1 kHz, delay 0, 1, 2 ticks.
TEST(StiffnessBound, GivesThePublishedFiguresOfTheFormula) {
  device::DeviceProfile ideal;
  ideal.viscous_Ns_m = 0.2;
  const double expected_N_m[] = {8400.0, 2800.0, 1680.0};
  for (int delay = 0; delay < 3; ++delay) {
    ideal.delay_ticks = delay;
    EXPECT_NEAR(stiffness_bound(ideal, 4.0).damping_N_m, expected_N_m[delay], 1e-6 * expected_N_m[delay]);
  }
}

TEST(StiffnessBound, TheSmallestOfTheThreeCountsAndIsNamed) {
  device::DeviceProfile profile;  // 2100, 10000 and 1000 N/m
  EXPECT_EQ(stiffness_bound(profile).smallest_N_m(), profile.max_stiffness_N_m);
  profile.max_stiffness_N_m = 1e5;
  profile.coulomb_N = 0.01;
  EXPECT_NEAR(stiffness_bound(profile).smallest_N_m(), 2.0 * 0.01 / 20e-6, 1e-9);
  EXPECT_NE(stiffness_bound(profile).why().find("encoder"), std::string::npos);
  profile.resolution_m = 0.0;
  EXPECT_NEAR(stiffness_bound(profile).smallest_N_m(), 1.05 / 0.5e-3, 1e-9);
  EXPECT_NE(stiffness_bound(profile).why().find("delay"), std::string::npos);
}

TEST(StiffnessBound, TheNoticeNamesTheWantedAndTheAllowedStiffness) {
  const device::DeviceProfile profile;
  EXPECT_EQ(stiffness_notice(profile, 1000.0), "");
  const std::string notice = stiffness_notice(profile, 3000.0);
  EXPECT_NE(notice.find("3000"), std::string::npos);
  EXPECT_NE(notice.find("1000"), std::string::npos);
  EXPECT_NE(notice.find("stiffness_N_m"), std::string::npos);
}

TEST(StiffnessBound, AnOlderAnswerBearsLess) {
  EXPECT_GT(stiffness_by_age_N_m(0.02), 1000.0);  // an ordinary step at 100 Hz limits no tool
  EXPECT_LT(stiffness_by_age_N_m(0.2), 0.5 * 1000.0);
}

}  // namespace
}  // namespace myotact::haptics
