// The loops of two devices that one person holds: one emergency stop, faults apart.

#include "haptics/haptic_group.h"

#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "device/simulated_device.h"
#include "haptics/faults.h"
#include "haptics/surfaces.h"
#include "support/allocation_guard.h"

namespace myotact::haptics {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000, kStep_ns = 10 * kTick_ns;

/// A simulated device that can go wrong.
class FaultyDevice : public device::SimulatedDevice {
 public:
  FaultyDevice() : SimulatedDevice("simulated", Vec3(0, 0, 0.01)) {}
  bool connected() const noexcept override { return !lost; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override {
    messages::DeviceState state = SimulatedDevice::read(now_ns);
    if (is_nan) state.stylus_position_world_m[1] = std::numeric_limits<double>::quiet_NaN();
    return state;
  }
  bool lost = false, is_nan = false;
};

/// A hand that presses 3 mm into a plane of its own.
struct Hand {
  explicit Hand(const HapticSettings& settings) : loop(device, settings) {
    device.set_hand_target({{0, 0, -0.003}, {}, 0});
  }
  void publish(std::uint64_t now_ns) {
    messages::LocalModel& model = loop.models().back();
    write_patch(plane, plane.positions_m, plane.positions_m, to_vec3(loop.tool_state().proxy_position_world_m), model);
    model.sequence = ++sequence;
    model.published_at_ns = now_ns;
    model.dt_ns = kStep_ns;
    loop.models().publish();
  }
  double force_N() const { return to_vec3(loop.tool_state().force_world_N).norm(); }
  void press_stop(bool down) { device.set_hand_target({{0, 0, -0.003}, {}, down ? messages::kStopButton : 0}); }

  geometry::TriangleMesh plane = geometry::make_plane(0.06, 10);
  FaultyDevice device;
  HapticLoop loop;
  std::uint64_t sequence = 0;
};

class Group : public ::testing::Test {
 protected:
  static HapticSettings quick() {
    HapticSettings settings;
    settings.gate.ramp_s = 0.1;
    return settings;
  }
  void SetUp() override {
    for (Hand* hand : hands) {
      hand->loop.prepare(now_ns);
      hand->publish(now_ns);
    }
    run(800);
    for (const Hand* hand : hands) ASSERT_GT(hand->force_N(), 0.3);
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      now_ns += kTick_ns;
      tick_all(loops, now_ns);
      if (now_ns % kStep_ns != 0) continue;
      for (Hand* hand : hands) hand->publish(now_ns);
    }
  }

  std::uint64_t now_ns = kTick_ns;
  Hand a{quick()}, b{quick()};
  std::array<Hand*, 2> hands{&a, &b};
  std::array<HapticLoop*, 2> loops{&a.loop, &b.loop};
};

TEST_F(Group, TheStopButtonOfEitherDeviceTakesTheForceFromBothWithinTwoTicks) {
  for (Hand* pressed : hands) {
    pressed->press_stop(true);
    run(2);
    for (const Hand* hand : hands) {
      EXPECT_EQ(hand->force_N(), 0.0);
      EXPECT_EQ(hand->device.motor_force_N().norm(), 0.0);
      EXPECT_TRUE(hand->loop.tool_state().faults & bit(Fault::Stopped));
    }
    pressed->press_stop(false);
    run(500);
    for (const Hand* hand : hands) EXPECT_EQ(hand->force_N(), 0.0);  // letting go re-enables nothing
    for (Hand* hand : hands) hand->device.set_hand_target({{0, 0, 0.01}, {}, 0});
    stop_forces(loops, false);
    run(500);  // armed in the open, where no force is wanted
    for (Hand* hand : hands) hand->device.set_hand_target({{0, 0, -0.003}, {}, 0});
    run(800);
    for (const Hand* hand : hands) EXPECT_GT(hand->force_N(), 0.3);  // armed both
  }
}

TEST_F(Group, ACallStopsAllFromTheNextTickOn) {
  stop_forces(loops, true);
  run(1);
  for (const Hand* hand : hands) EXPECT_EQ(hand->force_N(), 0.0);
}

TEST_F(Group, AFaultOfOneDeviceLeavesTheOtherHandItsForce) {
  const double before_N = b.force_N();
  a.device.is_nan = true;
  run(2);
  EXPECT_EQ(a.force_N(), 0.0);
  EXPECT_NEAR(b.force_N(), before_N, 0.05);
  a.device.is_nan = false;
  a.device.lost = true;
  run(200);
  EXPECT_EQ(a.force_N(), 0.0);
  EXPECT_TRUE(a.loop.tool_state().faults & bit(Fault::DeviceLost));
  EXPECT_NEAR(b.force_N(), before_N, 0.05);
}

TEST_F(Group, ARoundAllocatesNothing) {
  const support::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    now_ns += kTick_ns;
    tick_all(loops, now_ns);
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

// Two loops ticked together give the bits of each alone: they share nothing but the stop.
TEST_F(Group, ForcesAreThoseOfEachAlone) {
  Hand alone(quick());
  std::uint64_t alone_ns = kTick_ns;
  alone.loop.prepare(alone_ns);
  alone.publish(alone_ns);
  while (alone_ns < now_ns) {
    alone_ns += kTick_ns;
    alone.loop.tick(alone_ns);
    if (alone_ns % kStep_ns == 0) alone.publish(alone_ns);
  }
  for (const Hand* hand : hands) {
    EXPECT_EQ(alone.loop.tool_state().force_world_N, hand->loop.tool_state().force_world_N);
  }
}

}  // namespace
}  // namespace myotact::haptics
