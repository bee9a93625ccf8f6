#include "device/drivers/falcon/falcon_device.h"

#include <mutex>

#include <gtest/gtest.h>

#include "core/error.h"
#include "fake_falcon.h"
#include "realtime/periodic_loop.h"
#include "support/allocation_guard.h"

// The driver with its own thread on the steady clock, against a Falcon in software. States are waited for, not times.

namespace myotact::device::falcon {
namespace {

/// The software Falcon as the driver's thread and the test's hand share it.
struct SharedFalcon {
  std::mutex mutex;
  FakeFalcon fake;

  template <typename Action>
  void with(Action action) {
    const std::lock_guard lock(mutex);
    action(fake);
  }
};

class SharedTransport : public Transport {
 public:
  explicit SharedTransport(SharedFalcon& shared) : shared_(shared) {}

  bool request(std::uint8_t number, std::uint16_t value) noexcept override {
    const std::lock_guard lock(shared_.mutex);
    return shared_.fake.request(number, value);
  }
  bool send(std::span<const std::uint8_t> bytes) noexcept override {
    const std::lock_guard lock(shared_.mutex);
    return shared_.fake.send(bytes);
  }
  std::size_t receive(std::span<std::uint8_t> bytes, std::chrono::milliseconds patience) noexcept override {
    std::this_thread::sleep_for(std::chrono::microseconds(300));
    const std::lock_guard lock(shared_.mutex);
    return shared_.fake.receive(bytes, patience);
  }
  bool is_gone() const noexcept override {
    const std::lock_guard lock(shared_.mutex);
    return shared_.fake.is_gone();
  }

 private:
  SharedFalcon& shared_;
};

struct Rig {
  Rig()
      : device("falcon", {}, [this]() -> std::unique_ptr<Transport> {
          bool gone = false;
          falcon.with([&gone](FakeFalcon& fake) { gone = fake.is_gone(); });
          if (gone) throw Error(ExitStatus::Unavailable, "no Falcon on USB");
          return std::make_unique<SharedTransport>(falcon);
        }) {
    falcon.with([](FakeFalcon& fake) { fake.boot_with_firmware(); });
  }

  /// Ticks until it is so, for at most a minute.
  template <typename Condition>
  bool ticks_until(Condition condition, const Vec3& force_N = Vec3::Zero()) {
    for (int tick = 0; tick < 60'000; ++tick) {
      state = device.read(realtime::steady_now_ns());
      device.write({to_array(force_N)});
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  double felt_N() {
    double felt_N = 0.0;
    falcon.with([&](FakeFalcon& fake) { felt_N = fake.force_N(ExchangeSettings{}.counts_per_Nm).norm(); });
    return felt_N;
  }

  SharedFalcon falcon;
  FalconDevice device;
  messages::DeviceState state;
};

TEST(FalconDevice, HomesIsFeltAndIsQuietAfterwards) {
  Rig rig;
  rig.device.open();
  const Vec3 force_N(0.0, 1.0, 0.0);
  EXPECT_TRUE(rig.ticks_until([&] { return rig.device.report().phase == DevicePhase::NeedsCalibration; }, force_N));
  EXPECT_FALSE(rig.device.connected());
  EXPECT_EQ(rig.felt_N(), 0.0);
  EXPECT_NE(std::string(rig.device.report().hint), "");
  rig.falcon.with([](FakeFalcon& fake) { fake.home(); });
  EXPECT_TRUE(rig.ticks_until([&] { return rig.device.connected(); }));
  EXPECT_TRUE(rig.ticks_until([&] { return std::abs(rig.felt_N() - 1.0) < 0.01; }, force_N));
  EXPECT_LT(to_vec3(rig.state.stylus_position_world_m).norm(), 1e-4) << "the hand holds it in the middle";
  EXPECT_TRUE(rig.ticks_until([&] { return rig.device.report().rate_Hz > 0.0; }));
  rig.device.close();
  EXPECT_EQ(rig.felt_N(), 0.0);
  EXPECT_EQ(rig.device.report().phase, DevicePhase::Closed);
}

TEST(FalconDevice, AHostThatTicksNoMoreFeelsNothing) {
  Rig rig;
  rig.device.open();
  rig.falcon.with([](FakeFalcon& fake) { fake.home(); });
  EXPECT_TRUE(rig.ticks_until([&] { return rig.felt_N() > 0.9; }, {0.0, 1.0, 0.0}));
  for (int i = 0; i < 60'000 && rig.felt_N() > 0.0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(rig.felt_N(), 0.0) << "without a read or a write";
}

TEST(FalconDevice, ComesBackAfterItWasUnpluggedFromNoForce) {
  Rig rig;
  rig.device.open();
  rig.falcon.with([](FakeFalcon& fake) { fake.home(); });
  EXPECT_TRUE(rig.ticks_until([&] { return rig.felt_N() > 0.9; }, {0.0, 1.0, 0.0}));
  rig.falcon.with([](FakeFalcon& fake) { fake.set(Fault::Gone); });
  EXPECT_TRUE(rig.ticks_until([&] { return rig.device.report().phase == DevicePhase::Lost; }));
  EXPECT_TRUE(rig.ticks_until([&] { return !rig.device.connected(); }));
  rig.falcon.with([](FakeFalcon& fake) { fake.set(Fault::None); });
  EXPECT_TRUE(rig.ticks_until([&] { return rig.device.connected(); }));
}

TEST(FalconDevice, OneThatSaysNothingForSecondsIsStartedAgain) {
  Rig rig;
  rig.device.open();
  rig.falcon.with([](FakeFalcon& fake) { fake.home(); });
  EXPECT_TRUE(rig.ticks_until([&] { return rig.felt_N() > 0.9; }, {0.0, 1.0, 0.0}));
  rig.falcon.with([](FakeFalcon& fake) { fake.set(Fault::NoReply); });
  EXPECT_TRUE(rig.ticks_until([&] { return rig.device.report().phase == DevicePhase::Lost; }, {0.0, 1.0, 0.0}));
  EXPECT_FALSE(rig.device.connected());
  EXPECT_EQ(rig.felt_N(), 0.0);
  rig.falcon.with([](FakeFalcon& fake) { fake.set(Fault::None); });
  EXPECT_TRUE(rig.ticks_until([&] { return rig.device.connected(); }));
}

TEST(FalconDevice, WhatDoesNotOpenStaysClosed) {
  Rig rig;
  rig.falcon.with([](FakeFalcon& fake) { fake.set(Fault::Gone); });
  EXPECT_THROW(rig.device.open(), Error);
  EXPECT_EQ(rig.device.report().phase, DevicePhase::Closed);
  EXPECT_FALSE(rig.device.connected());
}

TEST(FalconDevice, ATickAllocatesNothing) {
  Rig rig;
  rig.device.open();
  const support::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    rig.device.read(realtime::steady_now_ns());
    rig.device.write({{0.1, 0.0, 0.0}});
    rig.device.connected();
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace
}  // namespace myotact::device::falcon
