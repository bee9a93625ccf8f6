// Another tool in the hand while it touches: what the device is given meanwhile, and where the other sphere begins.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "device/simulated_device.h"
#include "haptics/faults.h"
#include "haptics/haptic_loop.h"
#include "haptics/surfaces.h"
#include "support/allocation_guard.h"

namespace myotact::haptics {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;
constexpr messages::HeldTool kFinger{messages::ToolShape::Ball, 3e-3};
constexpr messages::HeldTool kPoint{messages::ToolShape::Point, 0.5e-3};
constexpr messages::HeldTool kClamp{messages::ToolShape::Clamp, 3e-3};

/// A hand on a surface at rest that is shown every 10 ms, with a bone and a line within reach.
class Touch {
 public:
  explicit Touch(const geometry::TriangleMesh& mesh, const Vec3& start_m)
      : device("simulated", start_m), loop(device, settings()), mesh_(mesh) {
    device.set_hand_target({to_array(start_m), {}, 0});
    loop.prepare(now_ns_);
    run(1200);  // the gate is open
  }
  void press(const Vec3& hand_m, std::uint32_t buttons, int ticks) {
    device.set_hand_target({to_array(hand_m), {}, buttons});
    run(ticks);
  }
  void choose(const messages::HeldTool& tool) { loop.chosen_tools().publish(tool); }
  /// What is wrong with the force of the ticks to come is counted.
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      const double before_N = force_N();
      const messages::HeldTool held = loop.held();
      if (now_ns_ % (10 * kTick_ns) == 0) show();
      now_ns_ += kTick_ns;
      const support::AllocationGuard guard;
      loop.tick(now_ns_);
      allocations += guard.allocations();
      most_damping_N = std::max(most_damping_N, to_vec3(loop.felt_tool().parts.damping).norm());
      largest_rise_N = std::max(largest_rise_N, force_N() - before_N);
      largest_fall_N = std::max(largest_fall_N, before_N - force_N());
      if (!(held == loop.held())) force_at_change_N = std::max(force_at_change_N, before_N);
      faults |= loop.tool_state().faults;
    }
  }
  double force_N() const { return to_vec3(loop.tool_state().force_world_N).norm(); }
  Vec3 sphere_m() const { return to_vec3(loop.tool_state().proxy_position_world_m); }
  void forget() {
    largest_rise_N = largest_fall_N = force_at_change_N = most_damping_N = 0.0;
    allocations = 0;
    faults = 0;
  }

  device::SimulatedDevice device;
  HapticLoop loop;
  double largest_rise_N = 0.0, largest_fall_N = 0.0, force_at_change_N = 0.0, most_damping_N = 0.0;
  std::uint64_t allocations = 0;
  std::uint32_t faults = 0;

 private:
  static HapticSettings settings() {
    HapticSettings settings;
    settings.contact.radius_m = kFinger.radius_m;
    settings.contact.static_friction = settings.contact.dynamic_friction = 0.0;
    return settings;
  }
  void show() {
    messages::LocalModel& model = loop.models().back();
    model = {};
    write_patch(mesh_, mesh_.positions_m, mesh_.positions_m, sphere_m(), model);
    model.sequence = ++sequence_;
    model.published_at_ns = now_ns_;
    model.dt_ns = 10 * kTick_ns;
    model.line = {0, 0.5, {0, 0, 0.01}, {-0.1, 0, 0.01}, {0.1, 0, 0.01}, 5.0, 0.2, 100.0, 0.0};
    model.grip.body = 0;
    model.grip.point_rest_m = model.grip.position_world_m = {0, 0, 0.01};
    loop.models().publish();
  }

  geometry::TriangleMesh mesh_;
  std::uint64_t now_ns_ = kTick_ns, sequence_ = 0;
};

TEST(ToolChange, InContactNoForceJumpsAndNoTickAllocates) {
  Touch touch(geometry::make_plane(0.06, 10), Vec3(0, 0, 0.01));
  touch.press(Vec3(0, 0, -2e-3), 0, 1500);
  const double slew_N = 1e-3 * GateSettings{}.slew_N_s;
  const double pressed_N = touch.force_N();
  ASSERT_GT(pressed_N, 1.0);
  touch.forget();
  for (const messages::HeldTool& tool : {kPoint, kFinger, kClamp, kPoint, kFinger}) {
    touch.choose(tool);
    touch.run(50);  // on its way out
    EXPECT_GT(touch.force_N(), 0.0);
    touch.run(1950);
    EXPECT_EQ(touch.loop.held(), tool);
    EXPECT_EQ(touch.loop.felt_tool().held, tool);
    EXPECT_EQ(touch.loop.gate_state(), GateState::On);
    EXPECT_NEAR(touch.sphere_m().z(), tool.radius_m, 0.03 * tool.radius_m) << "on the surface, not inside";
  }
  EXPECT_NEAR(touch.force_N(), pressed_N, 0.05) << "the same tool feels the same again";
  std::printf("pressed with %.2f N: rises by %.4f N a tick at most, falls by %.4f N, %.4f N of damping\n", pressed_N,
              touch.largest_rise_N, touch.largest_fall_N, touch.most_damping_N);
  EXPECT_LE(touch.largest_rise_N, slew_N);
  EXPECT_LE(touch.largest_fall_N, slew_N);
  EXPECT_EQ(touch.force_at_change_N, 0.0);
  EXPECT_EQ(touch.allocations, 0u);
  EXPECT_EQ(touch.faults & (bit(Fault::EnergyInjected) | bit(Fault::ProxyRescued) | bit(Fault::Buzz)), 0u);
}

/// A sphere of radius r rests r / sin(half the angle) above the bottom of a groove, on whichever way it came there.
TEST(ToolChange, AFingertipThatComesForAPointInAGrooveIsPushedOut) {
  const double half_angle_rad = std::numbers::pi / 6.0;
  const geometry::TriangleMesh groove = geometry::make_groove(2.0 * half_angle_rad, 0.04, 16);
  Touch touch(groove, Vec3(0, 0, 0.03));
  touch.choose(kPoint);
  for (int mm = 30; mm >= -2; --mm) touch.press(Vec3(0, 0, 1e-3 * mm), 0, 60);
  touch.run(1500);
  const double deep_m = kPoint.radius_m / std::sin(half_angle_rad);
  ASSERT_NEAR(touch.sphere_m().z(), deep_m, 0.1 * deep_m);
  touch.forget();
  touch.choose(kFinger);
  double lowest_m = 1.0;
  for (int tick = 0; tick < 2000; ++tick) {
    touch.run(1);
    lowest_m = std::min(lowest_m, touch.sphere_m().z());
  }
  const double held_off_m = kFinger.radius_m / std::sin(half_angle_rad);
  EXPECT_NEAR(touch.sphere_m().z(), held_off_m, 0.1 * held_off_m);
  EXPECT_GT(lowest_m, 0.9 * deep_m) << "never through the bottom";
  EXPECT_LE(touch.largest_rise_N, 1e-3 * GateSettings{}.slew_N_s);
  EXPECT_EQ(touch.faults & bit(Fault::ProxyRescued), 0u);
}

TEST(ToolChange, AClampLetsTheLineGoAndTakesABone) {
  Touch touch(geometry::make_plane(0.06, 10), Vec3(0, 0, 0.015));
  touch.press(Vec3(0, 0, 0.015), messages::kGrabButton, 500);
  ASSERT_EQ(touch.loop.tool_state().grabbed_line, 0);
  touch.forget();
  touch.choose(kClamp);
  touch.run(2000);
  EXPECT_EQ(touch.loop.tool_state().grabbed_line, -1);
  EXPECT_EQ(touch.loop.tool_state().grabbed_body, 0);
  EXPECT_LE(touch.largest_rise_N, 1e-3 * GateSettings{}.slew_N_s);
  EXPECT_EQ(touch.force_at_change_N, 0.0);
  EXPECT_EQ(touch.allocations, 0u);
}

TEST(ToolChange, WhileForcesAreStoppedItIsThereAtOnceAndNothingIsFelt) {
  Touch touch(geometry::make_plane(0.06, 10), Vec3(0, 0, 0.01));
  touch.press(Vec3(0, 0, -2e-3), 0, 1500);
  touch.loop.stop_forces(true);
  touch.run(1);
  touch.choose(kPoint);
  touch.run(2);
  EXPECT_EQ(touch.loop.held(), kPoint);
  EXPECT_EQ(touch.force_N(), 0.0);
  EXPECT_TRUE(touch.loop.is_stopped());
}

}  // namespace
}  // namespace myotact::haptics
