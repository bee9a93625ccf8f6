#include "device/drivers/spacemouse/spacemouse_device.h"

#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "device/drivers/spacemouse/fake_hid.h"
#include "messages/device.h"
#include "support/allocation_guard.h"

namespace myotact::device::spacemouse {
namespace {

using ::testing::ElementsAre;
using ::testing::StrEq;

constexpr std::uint64_t kTick_ns = 1'000'000;

/// Waits at most 20 s: far beyond what a busy machine takes.
template <typename Condition>
bool comes_true(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

class SpaceMouse : public ::testing::Test {
 protected:
  SpaceMouse() { bus_.plug(compact("/dev/hidraw3")); }

  /// One tick of a virtual clock.
  messages::DeviceState tick() { return device_.read(now_ns_ += kTick_ns); }
  bool is_seen(const FakeBus::Bytes& report, const std::function<bool(const messages::DeviceState&)>& seen) {
    bus_.send(report);
    return comes_true([&] { return seen(tick()); });
  }

  FakeBus bus_;
  std::uint64_t now_ns_ = 0;
  SpaceMouseDevice device_{"spacemouse", [this] { return bus_.open("/dev/hidraw3"); }};
};

const FakeBus::Bytes kRight = {0x01, 0x5E, 0x01, 0, 0, 0, 0};
const FakeBus::Bytes kRest = {0x01, 0, 0, 0, 0, 0, 0};
const FakeBus::Bytes kLeftKey = {0x03, 0x01};

bool moves_right(const messages::DeviceState& state) {
  return state.stylus_velocity_world_m_s[0] > 0.01;
}

TEST_F(SpaceMouse, ClosedItIsNotConnectedAndStandsStill) {
  EXPECT_FALSE(device_.connected());
  EXPECT_EQ(device_.report().phase, DevicePhase::Closed);
  EXPECT_THAT(tick().stylus_velocity_world_m_s, ElementsAre(0, 0, 0));
  EXPECT_TRUE(device_.profile().shows_force_only);
  EXPECT_THAT(device_.profile().workspace_m, ElementsAre(0.2, 0.2, 0.2)) << "the cube in which a rate moves";
}

TEST_F(SpaceMouse, TheLightIsOnWhileItIsOpen) {
  device_.open();
  EXPECT_TRUE(device_.connected());
  EXPECT_THAT(bus_.written(), ElementsAre(FakeBus::Bytes{4, 1}));
  device_.close();
  EXPECT_THAT(bus_.written(), ElementsAre(FakeBus::Bytes{4, 1}, FakeBus::Bytes{4, 0}));
  EXPECT_EQ(device_.report().phase, DevicePhase::Closed);
}

TEST_F(SpaceMouse, ADeflectionIsHeldUntilTheNextReport) {
  device_.open();
  ASSERT_TRUE(is_seen(kRight, moves_right));
  for (int i = 0; i < 500; ++i) tick();
  EXPECT_GT(tick().stylus_velocity_world_m_s[0], 0.1);
  EXPECT_TRUE(is_seen(kRest, [](const auto& state) { return state.stylus_velocity_world_m_s[0] < 1e-6; }));
  EXPECT_TRUE(is_seen(kLeftKey, [](const auto& state) { return state.buttons == messages::kGrabButton; }));
}

TEST_F(SpaceMouse, UnpluggedItIsLostAndPluggedInAgainItStartsFromRest) {
  device_.open();
  ASSERT_TRUE(is_seen(kRight, moves_right));
  ASSERT_TRUE(is_seen(kLeftKey, [](const auto& state) { return state.buttons != 0; }));
  bus_.unplug_all();
  ASSERT_TRUE(comes_true([&] { return device_.report().phase == DevicePhase::Lost; }));
  EXPECT_FALSE(device_.connected());
  EXPECT_THAT(device_.report().hint, StrEq("Plug the SpaceMouse in again."));
  const messages::DeviceState lost = tick();
  EXPECT_THAT(lost.stylus_velocity_world_m_s, ElementsAre(0, 0, 0));
  EXPECT_EQ(lost.buttons, 0U);
  EXPECT_EQ(tick().stylus_position_world_m, lost.stylus_position_world_m);

  bus_.plug(compact("/dev/hidraw3"));
  ASSERT_TRUE(comes_true([&] { return device_.connected(); }));
  const messages::DeviceState again = tick();
  EXPECT_THAT(again.stylus_velocity_world_m_s, ElementsAre(0, 0, 0));
  EXPECT_EQ(again.stylus_position_world_m, lost.stylus_position_world_m);
  EXPECT_TRUE(is_seen(kRight, moves_right));
}

TEST_F(SpaceMouse, AWeakBatteryIsTold) {
  device_.open();
  bus_.send({0x17, 0x05});
  EXPECT_TRUE(comes_true([&] { return std::string(device_.report().hint) == "Charge the SpaceMouse."; }));
}

TEST_F(SpaceMouse, ReportsAreCounted) {
  device_.open();
  EXPECT_TRUE(comes_true([&] {
    bus_.send(kRest);
    return device_.report().rate_Hz > 0.0;
  }));
}

TEST_F(SpaceMouse, OpensAgainAfterClosing) {
  for (int i = 0; i < 3; ++i) {
    device_.open();
    device_.open();  // nothing more
    EXPECT_TRUE(is_seen(kRight, moves_right));
    device_.close();
    device_.close();
    EXPECT_FALSE(device_.connected());
  }
}

TEST_F(SpaceMouse, OneThatIsNotThereThrows) {
  bus_.unplug_all();
  EXPECT_THROW(device_.open(), Error);
  EXPECT_FALSE(device_.connected());
}

TEST_F(SpaceMouse, ATickAllocatesNothing) {
  device_.open();
  ASSERT_TRUE(is_seen(kRight, moves_right));
  const support::AllocationGuard guard;
  for (int i = 0; i < 10'000; ++i) {
    const messages::DeviceState state = tick();
    device_.write({state.stylus_position_world_m});
    if (!device_.connected()) break;
  }
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace myotact::device::spacemouse
