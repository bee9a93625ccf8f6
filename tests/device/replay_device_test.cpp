#include "device/replay_device.h"

#include <gtest/gtest.h>

namespace myotact::device {
namespace {

TEST(ReplayDevice, PlaysStatesInOrderThenHoldsTheLastAtRest) {
  std::vector<messages::DeviceState> states(2);
  states[0].stylus_position_world_m = {1.0, 0.0, 0.0};
  states[1].stylus_position_world_m = {2.0, 0.0, 0.0};
  states[1].stylus_velocity_world_m_s = {1.0, 0.0, 0.0};
  states[1].sampled_at_ns = 7;
  ReplayDevice device(states, {});
  EXPECT_EQ(device.read(100).stylus_position_world_m[0], 1.0);
  EXPECT_FALSE(device.finished());
  EXPECT_EQ(device.read(200).sampled_at_ns, 7u);
  EXPECT_TRUE(device.finished());
  const messages::DeviceState held = device.read(300);
  EXPECT_EQ(held.stylus_position_world_m[0], 2.0);
  EXPECT_EQ(held.stylus_velocity_world_m_s[0], 0.0);
  EXPECT_EQ(held.sampled_at_ns, 300u);
}

TEST(ReplayDevice, OpeningRewindsAndShowsTheFirstStateOnceMore) {
  std::vector<messages::DeviceState> states(2);
  states[0].stylus_position_world_m = {1.0, 0.0, 0.0};
  states[1].stylus_position_world_m = {2.0, 0.0, 0.0};
  ReplayDevice device(states, {});
  device.read(1);
  device.open();
  EXPECT_EQ(device.read(2).stylus_position_world_m[0], 1.0);
  EXPECT_EQ(device.read(3).stylus_position_world_m[0], 1.0);
  EXPECT_EQ(device.read(4).stylus_position_world_m[0], 2.0);
}

TEST(ReplayDevice, NothingRecordedIsAStylusAtTheOrigin) {
  ReplayDevice device({}, {});
  EXPECT_EQ(device.read(1).stylus_position_world_m[0], 0.0);
}

}  // namespace
}  // namespace myotact::device
