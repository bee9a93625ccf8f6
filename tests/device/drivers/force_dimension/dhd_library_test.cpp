// The driver against a libdrd of the tests', loaded as the maker's would be. States are waited for; no time decides.

#include <array>
#include <chrono>
#include <functional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "device/drivers/force_dimension/force_dimension_driver.h"
#include "device/drivers/vendor_library.h"
#include "realtime/periodic_loop.h"
#include "support/allocation_guard.h"

namespace myotact::device::force_dimension {
namespace {

using ::testing::HasSubstr;

ForceDimensionSettings fake_settings() {
  ForceDimensionSettings settings;
  settings.library = FAKE_LIBDRD;
  return settings;
}

enum Asked { kForcesOn, kBraked, kGravity, kEmulates, kInitialisations, kEnables, kIsOpen };

class DhdLibraryTest : public ::testing::Test {
 protected:
  DhdLibraryTest() : library_("the tests' libdrd", {FAKE_LIBDRD}) {
    library_.bind("fake_dhd_reset", reset_);
    library_.bind("fake_dhd_count", count);
    library_.bind("fake_dhd_pose", pose_);
    library_.bind("fake_dhd_plug", plug);
    library_.bind("fake_dhd_fail", fail);
    library_.bind("fake_dhd_serial", serial);
    library_.bind("fake_dhd_force_off", force_off);
    library_.bind("fake_dhd_force", force_);
    library_.bind("fake_dhd_is", is);
    reset_();
  }
  ~DhdLibraryTest() override {
    device_.reset();
    reset_();
  }
  void open(const ForceDimensionSettings& settings = fake_settings()) {
    device_ = ForceDimensionDriver(settings).make("force_dimension");
    device_->open();
  }
  /// Ticks with one newton upwards until something is true; at most 30 s.
  bool ticks_until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end) {
      state_ = device_->read(realtime::steady_now_ns());
      device_->write({{0.0, 1.0, 0.0}});
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    return false;
  }
  Vec3 sent_N() const {
    Vec3 force_N;
    force_(0, force_N.data());
    return force_N;
  }
  bool becomes_felt() {
    return ticks_until([&] { return device_->connected() && sent_N() == Vec3(0.0, 0.0, 1.0); });
  }
  bool becomes(DevicePhase phase) {
    return ticks_until([&] { return device_->report().phase == phase && sent_N() == Vec3::Zero(); });
  }
  void pose(const Vec3& position_m, const Vec3& velocity_m_s, unsigned int buttons) {
    pose_(0, position_m.data(), velocity_m_s.data(), buttons);
  }

  void (*count)(int plugged, int result_of_open);
  void (*plug)(int device, bool is_plugged, bool is_powered, bool is_initialised);
  void (*fail)(int device, bool fails, int force_result);
  void (*serial)(int first);
  void (*force_off)(int device, int cause);
  long (*is)(int device, int what);
  std::unique_ptr<HardwareDevice> device_;
  messages::DeviceState state_;

 private:
  VendorLibrary library_;
  void (*reset_)();
  void (*pose_)(int device, const double* position_m, const double* velocity_m_s, unsigned int buttons);
  long (*force_)(int device, double* force_N);
};

TEST_F(DhdLibraryTest, IsFoundWithModelAndSerialNumber) {
  const auto findings = ForceDimensionDriver(fake_settings()).find();
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[1].name, "force_dimension:2");
  EXPECT_TRUE(findings[0].ready && findings[1].ready);
  EXPECT_THAT(findings[0].title, HasSubstr("omega.3, serial number 1000"));
  EXPECT_THAT(findings[1].title, HasSubstr("sigma.7"));
  EXPECT_EQ(is(0, kIsOpen), 0);
}

TEST_F(DhdLibraryTest, IsFeltAndLeftAtRest) {
  open();
  EXPECT_EQ(device_->profile().peak_force_N, 10.0) << "the library's, below the model's";
  EXPECT_EQ(device_->profile().max_stiffness_N_m, 5000.0);
  pose(Vec3(0.01, 0.02, 0.03), Vec3::Zero(), 1);
  EXPECT_TRUE(becomes_felt());
  EXPECT_TRUE(ticks_until([&] { return state_.buttons == messages::kGrabButton; }));
  EXPECT_NEAR((to_vec3(state_.stylus_position_world_m) - Vec3(0.02, 0.03, 0.01)).norm(), 0.0, 1e-12);
  EXPECT_EQ(is(0, kGravity), 1);
  EXPECT_EQ(is(0, kBraked), 0);
  EXPECT_EQ(is(0, kEmulates), 1);
  EXPECT_TRUE(ticks_until([&] { return device_->report().rate_Hz > 100.0; }));
  device_->close();
  EXPECT_EQ(sent_N(), Vec3::Zero());
  EXPECT_EQ(is(0, kForcesOn), 0);
  EXPECT_EQ(is(0, kBraked), 1);
  EXPECT_EQ(is(0, kIsOpen), 0);
  EXPECT_EQ(device_->report().phase, DevicePhase::Closed);
  open();
  device_->open();
  EXPECT_TRUE(becomes_felt());
}

TEST_F(DhdLibraryTest, AForceThatIsNotRenewedEnds) {
  open();
  EXPECT_TRUE(becomes_felt());
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (sent_N() != Vec3::Zero() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_EQ(sent_N(), Vec3::Zero());
}

TEST_F(DhdLibraryTest, UnpluggedItIsLostAndFoundAgain) {
  open();
  EXPECT_TRUE(becomes_felt());
  plug(0, false, true, true);
  EXPECT_TRUE(ticks_until([&] { return device_->report().phase == DevicePhase::Lost && !device_->connected(); }));
  EXPECT_STRNE(device_->report().hint, "");
  EXPECT_TRUE(ticks_until([&] { return is(0, kIsOpen) == 0; })) << "given up";
  plug(0, true, true, true);
  EXPECT_TRUE(becomes_felt());
}

TEST_F(DhdLibraryTest, AnotherOneAtItsPlaceIsLeftAlone) {
  ForceDimensionSettings settings = fake_settings();
  settings.initialises_itself = true;
  open(settings);
  EXPECT_TRUE(becomes_felt());
  plug(0, false, true, true);
  EXPECT_TRUE(ticks_until([&] { return is(0, kIsOpen) == 0; })) << "given up";
  serial(2000);
  plug(0, true, true, false);
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(1500);  // three looks
  ticks_until([&] { return device_->connected() || std::chrono::steady_clock::now() > end; });
  EXPECT_EQ(device_->report().phase, DevicePhase::Lost);
  serial(1000);
  EXPECT_TRUE(becomes(DevicePhase::NeedsCalibration)) << "and it does not move by itself, with a hand on it perhaps";
  EXPECT_EQ(is(0, kInitialisations), 0);
}

TEST_F(DhdLibraryTest, MotorsThatTakeNoForceAreSwitchedOff) {
  open();
  EXPECT_TRUE(becomes_felt());
  fail(0, false, -1);
  EXPECT_TRUE(ticks_until([&] { return !device_->connected() && is(0, kForcesOn) == 0; }));
  fail(0, false, 0);
  EXPECT_TRUE(becomes_felt());
}

TEST_F(DhdLibraryTest, ErrorsTakeTheForceAndAnswersOfTheMotorsDoNot) {
  open();
  EXPECT_TRUE(becomes_felt());
  fail(0, false, 2);
  EXPECT_TRUE(becomes_felt()) << "motors at their limit are no fault";
  fail(0, true, 0);
  EXPECT_TRUE(ticks_until([&] { return !device_->connected(); }));
  fail(0, false, 0);
  EXPECT_TRUE(becomes_felt());
}

TEST_F(DhdLibraryTest, AFastHandSwitchesOffAndAStillOneOnAgain) {
  open();
  EXPECT_TRUE(becomes_felt());
  pose(Vec3::Zero(), Vec3(0.5, 0.0, 0.0), 0);
  force_off(0, kByVelocity);
  EXPECT_TRUE(becomes(DevicePhase::Lost));
  EXPECT_THAT(device_->report().hint, HasSubstr("too fast"));
  const long enabled = is(0, kEnables);
  pose(Vec3::Zero(), Vec3::Zero(), 0);
  EXPECT_TRUE(becomes_felt());
  EXPECT_GT(is(0, kEnables), enabled);
  force_off(0, kByButton);
  EXPECT_TRUE(becomes(DevicePhase::Lost));
  EXPECT_THAT(device_->report().hint, HasSubstr("force button"));
}

TEST_F(DhdLibraryTest, OneThatDoesNotKnowWhereItIsMovesOnlyWhenAllowed) {
  plug(0, true, true, false);
  open();
  EXPECT_TRUE(becomes(DevicePhase::NeedsCalibration));
  EXPECT_EQ(is(0, kInitialisations), 0);
  device_->close();
  ForceDimensionSettings settings = fake_settings();
  settings.initialises_itself = true;
  open(settings);
  EXPECT_EQ(is(0, kInitialisations), 1);
  EXPECT_TRUE(becomes_felt());
}

TEST_F(DhdLibraryTest, WhatIsInUseOrAbsentSaysSo) {
  open();
  const auto findings = ForceDimensionDriver(fake_settings()).find();
  EXPECT_FALSE(findings[0].ready);
  EXPECT_THAT(findings[0].cause, HasSubstr("this program"));
  EXPECT_TRUE(becomes_felt()) << "looking did not disturb it";
  auto again = ForceDimensionDriver(fake_settings()).make("force_dimension");
  EXPECT_THROW(again->open(), Error);
  EXPECT_TRUE(becomes_felt());
  device_.reset();
  count(2, -1);
  const auto taken = ForceDimensionDriver(fake_settings()).find();
  EXPECT_THAT(taken[0].cause, HasSubstr("device already in use"));
  EXPECT_THAT(taken[0].remedy, HasSubstr("70-myotact.rules"));
  EXPECT_THROW(open(), Error);
  count(0, 0);
  EXPECT_FALSE(ForceDimensionDriver(fake_settings()).find()[0].ready);
  EXPECT_THROW(ForceDimensionDriver(fake_settings()).make("force_dimension"), Error);
}

TEST_F(DhdLibraryTest, ATickAllocatesNothing) {
  open();
  EXPECT_TRUE(becomes_felt());
  const support::AllocationGuard guard;
  for (int i = 0; i < 1000; ++i) {
    device_->read(realtime::steady_now_ns());
    device_->write({{0.0, 1.0, 0.0}});
    (void)device_->report();
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST_F(DhdLibraryTest, ALibraryWithoutDrdIsEnough) {
  ForceDimensionSettings settings;
  settings.library = FAKE_LIBDHD_WITHOUT_DRD;
  EXPECT_TRUE(ForceDimensionDriver(settings).find()[0].ready);
}

TEST(DhdVersions, MissingOlderAndIncompleteOnesAreNamed) {
  ForceDimensionSettings settings;
  settings.library = "/nowhere/libdhd.so";
  const auto missing = ForceDimensionDriver(settings).find();
  EXPECT_THAT(missing[0].cause, HasSubstr("/nowhere/libdhd.so"));
  EXPECT_THAT(missing[0].remedy, HasSubstr("Force Dimension SDK"));
  EXPECT_THROW(ForceDimensionDriver(settings).make("force_dimension"), Error);
  settings.library = FAKE_LIBDHD_OLD;
  EXPECT_THAT(ForceDimensionDriver(settings).find()[0].cause, HasSubstr("version 2.17"));
  settings.library = FAKE_LIBDHD_WITHOUT_SET_FORCE;
  EXPECT_THAT(ForceDimensionDriver(settings).find()[0].cause, HasSubstr("dhdSetForce"));
}

}  // namespace
}  // namespace myotact::device::force_dimension
