#include "device/drivers/force_dimension/exchange.h"

#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "device/drivers/force_dimension/models.h"

namespace myotact::device::force_dimension {
namespace {

using ::testing::HasSubstr;

constexpr double kPeak_N = 12.0;
constexpr std::uint64_t kTurn_ns = 500'000;

class Exchanges : public ::testing::Test {
 protected:
  Vec3 turn(const RawState& state, const Vec3& wanted_N = Vec3(1.0, 2.0, 3.0), std::uint64_t age_ns = 0) {
    now_ns_ += kTurn_ns;
    exchange_.take(state, now_ns_);
    return exchange_.allowed({to_array(wanted_N), now_ns_ - age_ns}, now_ns_);
  }
  RawState state_;
  Exchange exchange_{kPeak_N};
  std::uint64_t now_ns_ = 1'000'000'000;
};

TEST_F(Exchanges, AxesAreTurnedToOurs) {
  state_.position_m = Vec3(0.01, 0.02, 0.03);  // towards the person, right, up
  state_.velocity_m_s = Vec3(0.1, 0.0, 0.0);
  EXPECT_EQ(turn(state_), Vec3(3.0, 1.0, 2.0));
  EXPECT_EQ(to_vec3(exchange_.state().stylus_position_world_m), Vec3(0.02, 0.03, 0.01));
  EXPECT_EQ(to_vec3(exchange_.state().stylus_velocity_world_m_s), Vec3(0.0, 0.0, 0.1));
  EXPECT_EQ(device_from_library(library_from_device(Vec3(1.0, 2.0, 3.0))), Vec3(1.0, 2.0, 3.0));
}

TEST_F(Exchanges, AnErrorTakesTheForceForATenthOfASecond) {
  turn(state_);
  state_.result = -1;
  EXPECT_EQ(turn(state_), Vec3::Zero());
  EXPECT_EQ(exchange_.phase(), DevicePhase::Lost);
  state_.result = 2;  // motors at their limit: no error
  for (int i = 1; i < 200; ++i) ASSERT_EQ(turn(state_), Vec3::Zero()) << i;
  EXPECT_NE(turn(state_), Vec3::Zero());
}

TEST_F(Exchanges, ALeapIsNoHand) {
  turn(state_);
  state_.position_m.x() += 0.02;  // 40 m/s
  EXPECT_EQ(turn(state_), Vec3::Zero());
  for (int i = 1; i < 200; ++i) turn(state_);
  EXPECT_NE(turn(state_), Vec3::Zero());
  for (int i = 0; i < 100; ++i) {
    state_.position_m.y() += 0.0005;  // 1 m/s: a quick hand
    ASSERT_NE(turn(state_), Vec3::Zero());
  }
}

TEST_F(Exchanges, ForcesThatAreOldNoneOrTooLarge) {
  EXPECT_EQ(turn(state_, Vec3(1.0, 0.0, 0.0), 21'000'000), Vec3::Zero());
  EXPECT_NE(turn(state_, Vec3(1.0, 0.0, 0.0), 19'000'000), Vec3::Zero());
  EXPECT_EQ(turn(state_, Vec3(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0)), Vec3::Zero());
  EXPECT_EQ(turn(state_, Vec3(0.0, std::numeric_limits<double>::infinity(), 0.0)), Vec3::Zero());
  EXPECT_NEAR(turn(state_, Vec3(0.0, 100.0, 0.0)).z(), kPeak_N, 1e-12);
  EXPECT_EQ(exchange_.allowed({{1.0, 0.0, 0.0}, 0}, now_ns_), Vec3::Zero()) << "never asked for";
}

TEST_F(Exchanges, TheStatusTellsWhatIsWanted) {
  const auto hint_of = [&](const RawStatus& status) {
    exchange_.take(status);
    EXPECT_EQ(turn(state_), Vec3::Zero());
    return std::string(exchange_.hint());
  };
  EXPECT_THAT(hint_of({.is_powered = false}), HasSubstr("Switch"));
  EXPECT_THAT(hint_of({.is_connected = false}), HasSubstr("cable"));
  EXPECT_THAT(hint_of({.force_is_on = false, .force_off_cause = kByButton}), HasSubstr("force button"));
  EXPECT_THAT(hint_of({.force_is_on = false, .force_off_cause = kByVelocity}), HasSubstr("too fast"));
  EXPECT_THAT(hint_of({.is_initialised = false}), HasSubstr("--calibrate"));
  EXPECT_EQ(exchange_.phase(), DevicePhase::NeedsCalibration);
  exchange_.take(RawStatus{});
  EXPECT_NE(turn(state_), Vec3::Zero());
}

TEST_F(Exchanges, MotorsThatAFastHandSwitchedOffGoOnWhenItIsStill) {
  state_.velocity_m_s = Vec3(2.0, 0.0, 0.0);
  turn(state_);
  exchange_.take({.force_is_on = false, .force_off_cause = kByVelocity});
  state_.velocity_m_s = Vec3::Zero();
  for (int i = 0; i < 1999; ++i) {
    turn(state_);
    ASSERT_FALSE(exchange_.may_enable(now_ns_)) << i;
  }
  turn(state_);
  turn(state_);
  EXPECT_TRUE(exchange_.may_enable(now_ns_));
  exchange_.take({.force_is_on = false, .force_off_cause = kByButton});
  EXPECT_FALSE(exchange_.may_enable(now_ns_)) << "the person wanted it";
}

TEST_F(Exchanges, ButtonsAndTheGripper) {
  state_.buttons = 1;
  turn(state_);
  EXPECT_EQ(exchange_.state().buttons, messages::kGrabButton);
  state_.buttons = 2;
  turn(state_);
  EXPECT_EQ(exchange_.state().buttons, messages::kClutchButton);
  state_.buttons = 0xFFFF0000;
  turn(state_);
  EXPECT_EQ(exchange_.state().buttons, 0u);
}

TEST_F(Exchanges, AMillionWithFaultsNeverExceedAndAreZeroAtOnce) {
  std::mt19937 random(3);
  std::normal_distribution<double> force_N(0.0, 15.0);
  std::uint64_t felt = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const auto dice = random() % 4000;
    RawState state = state_;
    if (dice == 0) state.result = -1;
    if (dice == 1) state.position_m.y() = std::numeric_limits<double>::quiet_NaN();
    if (dice == 2) state.position_m.x() += 1.0;
    exchange_.take({.is_powered = dice != 3,
                    .is_connected = dice != 4,
                    .is_initialised = dice != 5,
                    .force_is_on = dice != 6,
                    .force_off_cause = kByVelocity});
    Vec3 wanted_N(force_N(random), force_N(random), force_N(random));
    if (random() % 50 == 0) wanted_N[static_cast<int>(random() % 3)] = std::numeric_limits<double>::infinity();
    const Vec3 sent_N = turn(state, wanted_N, random() % 30'000'000);
    ASSERT_LE(sent_N.norm(), kPeak_N * (1.0 + 1e-12));
    if (dice <= 6) {
      ASSERT_EQ(sent_N, Vec3::Zero()) << dice;
    }
    felt += sent_N != Vec3::Zero() ? 1 : 0;
  }
  EXPECT_GT(felt, 300'000u);
}

TEST(Models, HaveTheirLimitsAndTheLibrarysWhereTheyAreLower) {
  EXPECT_STREQ(model_of(33).title, "omega.3");
  EXPECT_EQ(profile_of(model_of(63), 0.0).peak_force_N, 20.0);
  EXPECT_EQ(profile_of(model_of(63), 5.0).peak_force_N, 5.0);
  EXPECT_EQ(profile_of(model_of(63), -1.0).peak_force_N, 20.0);
  EXPECT_EQ(profile_of(model_of(104), std::numeric_limits<double>::quiet_NaN()).peak_force_N, 12.0);
  EXPECT_EQ(model_of(4711).peak_force_N, 8.0) << "the weakest";
}

}  // namespace
}  // namespace myotact::device::force_dimension
