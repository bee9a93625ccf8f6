// The driver against a libHD of the tests', loaded as the maker's would be.

#include <cmath>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "device/drivers/touch/fake_hd.h"
#include "device/drivers/touch/touch_driver.h"
#include "support/allocation_guard.h"

namespace myotact::device::touch {
namespace {

using ::testing::HasSubstr;

TouchSettings fake_settings() {
  TouchSettings settings;
  settings.library = FAKE_LIBHD;
  settings.configurations = {"", "Left Device"};
  return settings;
}

/// Ticks by the test's hand.
class TouchLibraryTicks : public ::testing::Test {
 protected:
  void open() {
    touch_ = TouchDriver(fake_settings()).make("touch");
    touch_->open();
    start();
  }
  void start() {
    touch_->servo_clock()->start([this](std::uint64_t now_ns) {
      state_ = touch_->read(now_ns);
      if (writes_) touch_->write({force_N_});
      ++ticks_;
    });
  }
  void tick(int count = 1) {
    for (int i = 0; i < count; ++i) fake_.tick();
  }
  std::string refusal() {
    try {
      TouchDriver(fake_settings()).make("touch")->open();
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::Unavailable);
      return error.what();
    }
    return "";
  }

  FakeHd fake_;
  std::unique_ptr<HardwareDevice> touch_;
  messages::DeviceState state_;
  std::array<double, 3> force_N_{0.0, 1.0, 0.0};
  bool writes_ = true;
  int ticks_ = 0;
};

TEST_F(TouchLibraryTicks, AFrameReadsTicksAndSends) {
  fake_.pose(0, 10.0, 50.0, -20.0, 1);
  open();
  tick();
  EXPECT_EQ(ticks_, 1);
  EXPECT_TRUE(touch_->connected());
  EXPECT_EQ(fake_.sent_N(), Vec3(0.0, 1.0, 0.0));
  EXPECT_NEAR((to_vec3(state_.stylus_position_world_m) - Vec3(0.01, 0.0, 0.0)).norm(), 0.0, 1e-12)
      << "from the middle of the reach that the device tells";
  EXPECT_EQ(state_.buttons, messages::kGrabButton);
  EXPECT_EQ(touch_->profile().peak_force_N, 3.3);
  EXPECT_EQ(touch_->profile().workspace_m[1], 0.3);
  EXPECT_EQ(fake_.misuses(), 0);
}

TEST_F(TouchLibraryTicks, WhatIsNotWrittenInAFrameIsNoForce) {
  open();
  tick(3);
  writes_ = false;
  tick();
  EXPECT_EQ(fake_.sent_N(), Vec3::Zero());
}

TEST_F(TouchLibraryTicks, AnErrorTakesTheForceWithinTwoTicks) {
  open();
  tick(2);
  fake_.push_error(0x0302);
  tick();
  EXPECT_EQ(fake_.sent_N(), Vec3::Zero());
  EXPECT_EQ(touch_->report().phase, DevicePhase::Lost);
  EXPECT_THAT(touch_->report().hint, HasSubstr("cable"));
  EXPECT_FALSE(touch_->connected());
}

TEST_F(TouchLibraryTicks, CalibrationIsBroughtUpToDateOrAskedFor) {
  fake_.calibration(0, 0x5002, 4);
  open();
  tick(300);
  EXPECT_EQ(touch_->report().phase, DevicePhase::NeedsCalibration);
  EXPECT_THAT(touch_->report().hint, HasSubstr("inkwell"));
  EXPECT_EQ(fake_.sent_N(), Vec3::Zero());
  fake_.calibration(0, 0x5001, 4);
  tick(10);
  EXPECT_EQ(fake_.updates(0), 1);
  EXPECT_EQ(fake_.sent_N(), Vec3::Zero()) << "until it was asked for again";
  tick(11);
  EXPECT_TRUE(touch_->connected());
  EXPECT_EQ(fake_.sent_N(), Vec3(0.0, 1.0, 0.0));
}

TEST_F(TouchLibraryTicks, WarmthOfTheHottestMotor) {
  fake_.warmth(0, 0.7);
  open();
  tick();
  EXPECT_EQ(touch_->report().warmth, 0.7);
  fake_.warmth(0, std::nan(""));
  tick(101);
  EXPECT_LT(touch_->report().warmth, 0.0);
}

TEST_F(TouchLibraryTicks, AModelThatDoesNotTellItsWarmthIsFelt) {
  fake_.warmth(0, -1.0);
  open();
  tick(300);
  EXPECT_TRUE(touch_->connected());
  EXPECT_LT(touch_->report().warmth, 0.0);
  fake_.push_error(0x0100);
  tick();
  EXPECT_FALSE(touch_->connected()) << "the same error of a frame is one";
}

TEST_F(TouchLibraryTicks, OfTwoTheOneThatIsLeftIsNotReadyWhileNothingTicks) {
  auto left = TouchDriver(fake_settings()).make("touch:2");
  left->open();
  open();
  tick();
  EXPECT_TRUE(left->connected());
  touch_->close();
  EXPECT_FALSE(left->connected());
  EXPECT_EQ(left->report().phase, DevicePhase::Opening);
}

TEST_F(TouchLibraryTicks, AnotherLibraryBesideTheOneInUseIsRefused) {
  open();
  TouchSettings settings = fake_settings();
  settings.library = FAKE_LIBHD_WITHOUT_END_FRAME;
  EXPECT_THAT(TouchDriver(settings).find()[0].cause, HasSubstr("another libHD"));
  tick();
  EXPECT_TRUE(touch_->connected());
}

TEST_F(TouchLibraryTicks, AfterTheStopNothingMoves) {
  open();
  tick();
  std::thread servo([this] {  // the last frame is waited for
    for (int i = 0; i < 20; ++i) {
      fake_.tick();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  touch_->servo_clock()->stop();
  EXPECT_EQ(fake_.sent_N(), Vec3::Zero());
  servo.join();
  const int ticks = ticks_;
  tick(5);
  EXPECT_EQ(ticks_, ticks);
  touch_->write({{0.0, 1.0, 0.0}});
  EXPECT_EQ(fake_.sent_N(), Vec3::Zero());
  start();
  tick();
  EXPECT_EQ(fake_.sent_N(), Vec3(0.0, 1.0, 0.0)) << "and it begins again";
}

TEST_F(TouchLibraryTicks, TwoDevicesShareTheServoLoop) {
  TouchDriver left_driver(fake_settings());
  auto left = left_driver.make("touch:2");
  left->open();
  touch_ = TouchDriver(fake_settings()).make("touch");
  touch_->open();
  EXPECT_EQ(left->servo_clock(), touch_->servo_clock());
  fake_.pose(1, 0.0, 50.0, -10.0, 0);
  messages::DeviceState left_state;
  touch_->servo_clock()->start([&](std::uint64_t now_ns) {
    left_state = left->read(now_ns);
    left->write({{0.5, 0.0, 0.0}});
    touch_->write({{0.0, 0.0, 2.0}});
  });
  tick();
  EXPECT_EQ(fake_.sent_N(0), Vec3(0.0, 0.0, 2.0));
  EXPECT_EQ(fake_.sent_N(1), Vec3(0.5, 0.0, 0.0));
  EXPECT_NEAR(left_state.stylus_position_world_m[2], 0.01, 1e-12);
  EXPECT_EQ(fake_.misuses(), 0);
  EXPECT_EQ(left_driver.find()[0].cause, "this program has a Touch open");
  EXPECT_EQ(fake_.sent_N(0), Vec3(0.0, 0.0, 2.0));
}

TEST_F(TouchLibraryTicks, ATickAllocatesNothing) {
  open();
  tick(2);
  const support::AllocationGuard guard;
  tick(1000);
  fake_.push_error(0x0203);
  tick(300);
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST_F(TouchLibraryTicks, ManyTicksWithFaultsNeverExceedAndAreZeroWithinTwo) {
  open();
  std::mt19937 random(11);
  int quiet = 0;
  for (int i = 0; i < 200'000; ++i) {
    force_N_ = {10.0, -10.0, static_cast<double>(random() % 20)};
    const auto dice = random() % 3000;
    if (dice == 0) fake_.push_error(static_cast<Code>(0x0200 + random() % 5));
    if (dice == 1) fake_.push_error(static_cast<Code>(0x0300 + random() % 5));
    if (dice == 2) fake_.pose(0, std::nan(""), 0.0, 0.0, 0);
    if (dice == 3) fake_.pose(0, 0.0, 50.0, 0.0, 0);
    tick();
    ASSERT_LE(fake_.sent_N().norm(), 3.3 * (1.0 + 1e-12));
    quiet = dice <= 2 ? 2 : std::max(0, quiet - 1);
    if (dice <= 2) {
      ASSERT_EQ(fake_.sent_N(), Vec3::Zero());
    }
  }
  EXPECT_EQ(fake_.misuses(), 0);
}

TEST_F(TouchLibraryTicks, ASchedulerThatRefusesIsTold) {
  touch_ = TouchDriver(fake_settings()).make("touch");
  touch_->open();
  fake_.fail(0, 0x0304);
  EXPECT_THROW(start(), Error);
  fake_.fail(0, 0);
  start();
  tick();
  EXPECT_TRUE(touch_->connected());
}

TEST_F(TouchLibraryTicks, OneThatDidNotAnswerIsOpenedAnewBeforeItTicksAgain) {
  open();
  tick(2);
  EXPECT_TRUE(touch_->connected());
  fake_.push_error(kCommunication);
  tick();
  EXPECT_EQ(touch_->report().phase, DevicePhase::Lost);
  touch_->servo_clock()->stop();
  fake_.fail(kCommunication, 0);  // still unplugged
  EXPECT_THROW(start(), Error);
  tick();
  EXPECT_FALSE(touch_->connected());
  EXPECT_THROW(start(), Error);
  fake_.fail(0, 0);
  start();
  tick();
  EXPECT_TRUE(touch_->connected());
  EXPECT_EQ(fake_.sent_N(), Vec3(0.0, 1.0, 0.0));
  EXPECT_EQ(fake_.opened(), 2);
  EXPECT_EQ(fake_.misuses(), 0);
}

TEST_F(TouchLibraryTicks, OneThatIsGoneForGoodIsClosed) {
  open();
  fake_.push_error(kCommunication);
  tick();
  fake_.fail(kCommunication, 0);
  EXPECT_THROW(start(), Error);
  touch_->close();
  EXPECT_EQ(touch_->report().phase, DevicePhase::Closed);
  fake_.fail(0, 0);
  touch_->open();
  start();
  tick();
  EXPECT_TRUE(touch_->connected());
}

TEST_F(TouchLibraryTicks, WhatDoesNotOpenSaysWhy) {
  fake_.fail(0x0302, 0);
  EXPECT_THAT(refusal(), HasSubstr("Communication error (0x0302)"));
  EXPECT_THAT(refusal(), HasSubstr("70-myotact.rules"));
  fake_.fail(0x0301, 0);
  EXPECT_THAT(refusal(), HasSubstr("other program"));
  const auto findings = TouchDriver(fake_settings()).find();
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_FALSE(findings[0].ready);
  EXPECT_THAT(findings[0].cause, HasSubstr("already initiated"));
  fake_.fail(0, 0);
  const auto now = TouchDriver(fake_settings()).find();
  EXPECT_TRUE(now[0].ready && now[1].ready);
  EXPECT_THAT(now[1].title, HasSubstr("Left Device"));
  EXPECT_THAT(now[0].title, HasSubstr("SN123"));
}

TEST_F(TouchLibraryTicks, LimitsThatAreNoneAreNotTaken) {
  fake_.max_force(-1.0);
  touch_ = TouchDriver(fake_settings()).make("touch");
  touch_->open();
  EXPECT_EQ(touch_->profile().peak_force_N, 3.3) << "of the profile";
  touch_->open();
  touch_->close();
  touch_->close();
  EXPECT_EQ(touch_->report().phase, DevicePhase::Closed);
}

TEST(TouchLibrary, MissingOnesAreNamed) {
  TouchSettings settings;
  settings.library = "/nowhere/libHD.so";
  const auto findings = TouchDriver(settings).find();
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_FALSE(findings[0].ready);
  EXPECT_THAT(findings[0].cause, HasSubstr("/nowhere/libHD.so"));
  EXPECT_THAT(findings[0].remedy, HasSubstr("OpenHaptics"));
  EXPECT_THROW(TouchDriver(settings).make("touch"), Error);
  EXPECT_THROW(TouchDriver(settings).make("touch:2"), Error);
}

TEST(TouchLibrary, OneWithoutAFunctionIsAnotherVersion) {
  TouchSettings settings;
  settings.library = FAKE_LIBHD_WITHOUT_END_FRAME;
  const auto findings = TouchDriver(settings).find();
  EXPECT_FALSE(findings[0].ready);
  EXPECT_THAT(findings[0].cause, HasSubstr("hdEndFrame"));
}

TEST(TouchLibrary, ItsOwnServoThreadTicks) {
  FakeHd fake(false);
  auto touch = TouchDriver(fake_settings()).make("touch");
  touch->open();
  std::atomic<int> ticks{0};
  touch->servo_clock()->start([&](std::uint64_t now_ns) {
    touch->read(now_ns);
    touch->write({{0.0, 1.0, 0.0}});
    ++ticks;
  });
  while (ticks < 200) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(fake.sent_N(), Vec3(0.0, 1.0, 0.0));
  touch->servo_clock()->stop();
  EXPECT_EQ(fake.sent_N(), Vec3::Zero());
  EXPECT_EQ(fake.misuses(), 0);
}

TEST(TouchLibrary, OneThatAnswersStaysOpenFromSceneToScene) {
  FakeHd fake(false);
  auto touch = TouchDriver(fake_settings()).make("touch");
  touch->open();
  for (int scene = 0; scene < 3; ++scene) {
    std::atomic<int> ticks{0};
    touch->servo_clock()->start([&](std::uint64_t) { ++ticks; });
    while (ticks < 20) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    fake.push_error(kExceededVelocity);
  }
  EXPECT_EQ(fake.opened(), 1);
}

}  // namespace
}  // namespace myotact::device::touch
