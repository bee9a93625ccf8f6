#include "device/drivers/touch/frame_validator.h"

#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myotact::device::touch {
namespace {

using ::testing::HasSubstr;

constexpr double kPeak_N = 3.3;
constexpr std::uint64_t kTick_ns = 1'000'000;

class Frames : public ::testing::Test {
 protected:
  Vec3 turn(const RawFrame& frame, const std::array<double, 3>& wanted_N = {0.0, 1.0, 0.0}) {
    validator_.take(frame, now_ns_ += kTick_ns);
    return validator_.allowed(wanted_N, kPeak_N);
  }
  RawFrame frame_;
  FrameValidator validator_{Vec3(0.0, 50.0, -20.0)};
  std::uint64_t now_ns_ = 1'000'000'000;
};

TEST_F(Frames, MillimetresFromTheMiddleOfTheWorkspace) {
  frame_.position_mm = {10.0, 50.0, -40.0};
  frame_.velocity_mm_s = {100.0, 0.0, 0.0};
  frame_.buttons = 1 | 2;
  EXPECT_EQ(turn(frame_), Vec3(0.0, 1.0, 0.0));
  EXPECT_NEAR((to_vec3(validator_.state().stylus_position_world_m) - Vec3(0.01, 0.0, -0.02)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(validator_.state().stylus_velocity_world_m_s[0], 0.1, 1e-12);
  EXPECT_EQ(validator_.state().buttons, messages::kGrabButton | messages::kClutchButton);
  EXPECT_EQ(validator_.state().sampled_at_ns, now_ns_);
}

TEST_F(Frames, EveryErrorTakesTheForceAtOnceAndGivesItBackInItsTime) {
  const std::pair<Code, int> rests_ms[] = {{kWarmMotors, 2000},    {kExceededForce, 100}, {kExceededVelocity, 100},
                                           {kCommunication, 1000}, {kDeviceFault, 1000},  {0x0402, 1000}};
  for (const auto& [error, rest_ms] : rests_ms) {
    frame_.error = error;
    EXPECT_EQ(turn(frame_), Vec3::Zero());
    EXPECT_EQ(validator_.phase(), DevicePhase::Lost);
    EXPECT_STRNE(validator_.hint(), "");
    frame_.error = kNone;
    for (int ms = 1; ms < rest_ms; ++ms) ASSERT_EQ(turn(frame_), Vec3::Zero()) << error << " after " << ms;
    EXPECT_EQ(turn(frame_), Vec3(0.0, 1.0, 0.0)) << error;
    EXPECT_STREQ(validator_.hint(), "");
  }
}

TEST_F(Frames, NoForceWithoutCalibrationAndAHintByItsStyle) {
  frame_.calibration = kCalibrationNeedsInput;
  frame_.style = kInkwell;
  EXPECT_EQ(turn(frame_), Vec3::Zero());
  EXPECT_EQ(validator_.phase(), DevicePhase::NeedsCalibration);
  EXPECT_THAT(validator_.hint(), HasSubstr("inkwell"));
  frame_.style = kAutomatic;
  turn(frame_);
  EXPECT_THAT(validator_.hint(), HasSubstr("whole reach"));
  frame_.style = kEncoderReset;
  turn(frame_);
  EXPECT_THAT(validator_.hint(), HasSubstr("rest position"));
}

TEST_F(Frames, ForcesThatAreNoneOrTooLarge) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(turn(frame_, {nan, 0.0, 0.0}), Vec3::Zero());
  EXPECT_EQ(turn(frame_, {0.0, inf, 0.0}), Vec3::Zero());
  EXPECT_EQ(turn(frame_, {1e200, 1e200, 0.0}), Vec3::Zero()) << "its size is not a number";
  EXPECT_NEAR(turn(frame_, {0.0, 0.0, 100.0}).z(), kPeak_N, 1e-12);
}

TEST_F(Frames, PositionsThatAreNoneAreNotTaken) {
  frame_.position_mm = {10.0, 50.0, -20.0};
  turn(frame_);
  frame_.position_mm = {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};
  EXPECT_EQ(turn(frame_), Vec3::Zero());
  EXPECT_NEAR(validator_.state().stylus_position_world_m[0], 0.01, 1e-12);
}

TEST_F(Frames, ALeapTakesTheForceForAWhile) {
  turn(frame_);
  frame_.position_mm = {0.0, 0.0, 9.0};  // 9 m/s: 5 m/s and 5 mm on top are a hand's
  EXPECT_EQ(turn(frame_), Vec3(0.0, 1.0, 0.0));
  frame_.position_mm = {0.0, 0.0, 209.0};
  EXPECT_EQ(turn(frame_), Vec3::Zero());
  EXPECT_EQ(validator_.phase(), DevicePhase::Lost);
  for (int ms = 1; ms < 100; ++ms) ASSERT_EQ(turn(frame_), Vec3::Zero());
  EXPECT_EQ(turn(frame_), Vec3(0.0, 1.0, 0.0));
}

TEST_F(Frames, AMillionWithFaultsNeverExceedAndAreZeroAtOnce) {
  std::mt19937 random(5);
  const std::array errors = {Code{kWarmMotors}, Code{kExceededForce}, Code{kCommunication}, Code{0x0101}};
  std::normal_distribution<double> force_N(0.0, 5.0);
  std::uint64_t felt = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    frame_ = {};
    const auto dice = random() % 5000;
    if (dice == 0) frame_.error = errors[random() % errors.size()];
    if (dice == 1) frame_.calibration = kCalibrationNeedsUpdate;
    if (dice == 2) frame_.position_mm[random() % 3] = std::numeric_limits<double>::quiet_NaN();
    std::array<double, 3> wanted_N = {force_N(random), force_N(random), force_N(random)};
    if (random() % 100 == 0) wanted_N[random() % 3] = std::numeric_limits<double>::infinity();
    const Vec3 sent_N = turn(frame_, wanted_N);
    ASSERT_LE(sent_N.norm(), kPeak_N * (1.0 + 1e-12));
    if (dice <= 2) {
      ASSERT_EQ(sent_N, Vec3::Zero());
    }
    felt += sent_N != Vec3::Zero() ? 1 : 0;
  }
  EXPECT_GT(felt, 300'000u);
}

}  // namespace
}  // namespace myotact::device::touch
