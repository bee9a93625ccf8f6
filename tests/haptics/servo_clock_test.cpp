#include <stdexcept>

#include <gtest/gtest.h>

#include "core/error.h"
#include "device/simulated_device.h"
#include "haptics/haptic_thread.h"

// Loops whose ticks a maker's library makes.

namespace myotact::haptics {
namespace {

/// A library's servo thread, played by the test.
class PlayedServo : public device::ServoClock {
 public:
  void start(std::function<void(std::uint64_t)> tick) override {
    if (refuses) throw Error(ExitStatus::Unavailable, "the scheduler is full");
    tick_ = std::move(tick);
  }
  void stop() noexcept override { tick_ = nullptr; }
  void tick_after(std::uint64_t period_ns) { tick_(now_ns += period_ns); }
  bool runs() const { return tick_ != nullptr; }

  std::uint64_t now_ns = 1'000'000'000;
  bool refuses = false;

 private:
  std::function<void(std::uint64_t)> tick_;
};

TEST(ServoClock, ItsTicksAreTheLoops) {
  device::SimulatedDevice device("simulated", Vec3::Zero());
  HapticLoop loop(device, {});
  PlayedServo servo;
  HapticThread thread(loop, nullptr, &servo);
  loop.prepare(servo.now_ns);
  thread.start();
  for (int i = 0; i < 10; ++i) servo.tick_after(1'000'000);
  EXPECT_EQ(thread.tick_count(), 10u);
  EXPECT_EQ(thread.missed_count(), 0u);
  EXPECT_EQ(loop.last_tick().device.sampled_at_ns, servo.now_ns);
  servo.tick_after(4'200'000);
  EXPECT_EQ(thread.missed_count(), 3u);
  EXPECT_NE(loop.tool_state().faults, 0u) << "a missed deadline";
  thread.stop();
  EXPECT_FALSE(servo.runs());
  EXPECT_EQ(loop.gate_state(), GateState::Off);
  EXPECT_EQ(to_vec3(loop.tool_state().force_world_N).norm(), 0.0);
  thread.stop();
  EXPECT_EQ(thread.tick_count(), 11u);
}

TEST(ServoClock, OneThatRefusesLeavesNothingRunning) {
  device::SimulatedDevice device("simulated", Vec3::Zero());
  HapticLoop loop(device, {});
  PlayedServo servo;
  servo.refuses = true;
  HapticThread thread(loop, nullptr, &servo);
  loop.prepare(servo.now_ns);
  EXPECT_THROW(thread.start(), Error);
}

}  // namespace
}  // namespace myotact::haptics
