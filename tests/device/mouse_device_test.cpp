#include "device/mouse_device.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myotact::device {
namespace {

TEST(MouseDevice, FollowsThePointerWithoutAJump) {
  MouseDevice device(Vec3::Zero());
  device.read(0);
  device.set_pointer(Vec3(0.03, 0.0, 0.0), messages::kGrabButton);
  double last_m = 0.0;
  for (std::uint64_t tick = 1; tick <= 300; ++tick) {
    const messages::DeviceState state = device.read(tick * 1'000'000);
    EXPECT_GE(state.stylus_position_world_m[0], last_m);
    EXPECT_LE(state.stylus_position_world_m[0] - last_m, 1.1e-3);  // 30 mm over a lag of 30 ms, at 1 ms a tick
    EXPECT_EQ(state.buttons, messages::kGrabButton);
    last_m = state.stylus_position_world_m[0];
  }
  EXPECT_NEAR(last_m, 0.03, 1e-5);
}

TEST(MouseDevice, VelocityIsTheSlopeOfThePosition) {
  MouseDevice device(Vec3::Zero());
  device.read(0);
  device.set_pointer(Vec3(0.03, 0.0, 0.0), 0);
  const messages::DeviceState a = device.read(1'000'000);
  const messages::DeviceState b = device.read(1'100'000);
  const double slope_m_s = (b.stylus_position_world_m[0] - a.stylus_position_world_m[0]) / 1e-4;
  EXPECT_NEAR(b.stylus_velocity_world_m_s[0], slope_m_s, 0.01 * slope_m_s);
}

TEST(MouseDevice, KeepsTheForceForTheWindow) {
  MouseDevice device(Vec3::Zero());
  device.write({{1.0, 2.0, 3.0}});
  EXPECT_EQ(device.shown_force_world_N()[2], 3.0);
}

}  // namespace
}  // namespace myotact::device
