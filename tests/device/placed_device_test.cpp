#include "device/placed_device.h"

#include <limits>
#include <random>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/allocation_guard.h"

namespace myotact::device {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;

/// A device on the table whose hand the test moves.
class Table : public HardwareDevice {
 public:
  const std::string& name() const override { return name_; }
  const DeviceProfile& profile() const override { return profile_; }
  void open() override { profile_.peak_force_N = 7.0; }  // as one that reports its limits
  void close() noexcept override {}
  bool connected() const noexcept override { return is_connected; }
  messages::DeviceState read(std::uint64_t) noexcept override { return state; }
  void write(const messages::DeviceCommand& command) noexcept override { force_N = to_vec3(command.force_world_N); }
  DeviceReport report() const noexcept override { return {}; }

  void put(const Vec3& position_m, std::uint32_t buttons = 0) {
    state.stylus_position_world_m = to_array(position_m);
    state.buttons = buttons;
  }

  bool is_connected = true;
  messages::DeviceState state;
  Vec3 force_N = Vec3::Zero();

 private:
  std::string name_ = "table";
  DeviceProfile profile_;
};

struct Placed {
  explicit Placed(const Placement& placement) : device(table, placement) {}

  Vec3 read() { return to_vec3(device.read(now_ns += kTick_ns).stylus_position_world_m); }

  Table table;
  PlacedDevice device;
  std::uint64_t now_ns = 0;
};

Placement turned(double scale) {
  Placement placement;
  placement.world_from_device = Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  placement.middle_world_m = {0.3, -0.2, 0.9};
  placement.scale = scale;
  return placement;
}

TEST(PlacedDevice, TurnsAndScalesMotionAndTurnsForceBack) {
  const Placement placement = turned(2.5);
  Placed placed(placement);
  placed.table.put({0.01, 0.02, -0.03});
  placed.table.state.stylus_velocity_world_m_s = {0.1, 0.0, 0.0};
  EXPECT_TRUE(
      placed.read().isApprox(placement.middle_world_m + 2.5 * (placement.world_from_device * Vec3(0.01, 0.02, -0.03))));
  const Vec3 velocity_m_s = to_vec3(placed.device.read(placed.now_ns).stylus_velocity_world_m_s);
  EXPECT_TRUE(velocity_m_s.isApprox(0.25 * placement.world_from_device.col(0)));
  placed.device.write({to_array(Vec3(placement.world_from_device.col(1)))});
  EXPECT_TRUE(placed.table.force_N.isApprox(Vec3::UnitY(), 1e-12));
}

TEST(PlacedDevice, TheWorkOnTheTableIsThatInTheWorldOverTheScale) {
  Placed placed(turned(3.0));
  std::mt19937 random(7);
  std::normal_distribution<double> step_m(0.0, 1e-3), force_N(0.0, 1.0);
  double on_table_J = 0.0, in_world_J = 0.0;
  Vec3 hand_m = Vec3::Zero(), tool_m = placed.read();
  for (int tick = 0; tick < 1000; ++tick) {
    const Vec3 force_world_N(force_N(random), force_N(random), force_N(random));
    placed.device.write({to_array(force_world_N)});
    const Vec3 moved_m(step_m(random), step_m(random), step_m(random));
    placed.table.put(hand_m += moved_m);
    const Vec3 next_m = placed.read();
    on_table_J += placed.table.force_N.dot(moved_m);
    in_world_J += force_world_N.dot(next_m - tool_m);
    tool_m = next_m;
  }
  EXPECT_NEAR(in_world_J, 3.0 * on_table_J, 1e-12);
}

TEST(PlacedDevice, TellsItsProfileAsTheWorldSeesIt) {
  Placed placed(turned(4.0));
  const DeviceProfile table;
  placed.device.open();
  EXPECT_EQ(placed.device.profile().peak_force_N, 7.0) << "what the device told when it opened";
  EXPECT_DOUBLE_EQ(placed.device.profile().max_stiffness_N_m, table.max_stiffness_N_m / 4.0);
  EXPECT_DOUBLE_EQ(placed.device.profile().inertia_kg, table.inertia_kg / 4.0);
  EXPECT_DOUBLE_EQ(placed.device.profile().viscous_Ns_m, table.viscous_Ns_m / 4.0);
  EXPECT_DOUBLE_EQ(placed.device.profile().resolution_m, table.resolution_m * 4.0);
  EXPECT_DOUBLE_EQ(placed.device.profile().workspace_m[0], table.workspace_m[0] * 4.0);
  EXPECT_DOUBLE_EQ(placed.device.profile().motion_scale, 4.0);
}

TEST(PlacedDevice, TheToolStaysWhileTheClutchIsHeldAndGoesOnFromThere) {
  Placed placed(turned(2.0));
  placed.table.put({0.05, 0.0, 0.0});
  const Vec3 before_m = placed.read();
  for (int tick = 0; tick < 100; ++tick) {
    placed.table.put({0.05 - 1e-3 * tick, 0.0, 0.0}, messages::kClutchButton);
    placed.table.state.stylus_velocity_world_m_s = {-1.0, 0.0, 0.0};
    EXPECT_TRUE(placed.read().isApprox(before_m, 1e-12)) << tick;
    EXPECT_EQ(placed.device.read(placed.now_ns).stylus_velocity_world_m_s, (std::array{0.0, 0.0, 0.0}));
  }
  placed.table.put({-0.049, 0.0, 0.0});
  EXPECT_TRUE(placed.read().isApprox(before_m, 1e-12));
  placed.table.put({-0.039, 0.0, 0.0});
  EXPECT_NEAR((placed.read() - before_m).norm(), 0.02, 1e-12);
}

TEST(PlacedDevice, ATurnOfTheViewTurnsTheHandsAxesAboutTheTool) {
  Placed placed(turned(2.0));
  placed.table.put({0.01, 0.02, 0.03});
  const Vec3 before_m = placed.read();
  const Mat3 turn = Eigen::AngleAxisd(2.0, Vec3(0.3, -1.0, 0.2).normalized()).toRotationMatrix();
  placed.device.write({{0.0, 1.0, 0.0}});  // a force is felt
  placed.device.ask_rotation(turn);
  EXPECT_EQ(placed.read(), before_m);
  placed.table.put({0.02, 0.02, 0.03});
  EXPECT_NEAR((placed.read() - before_m - turned(2.0).world_from_device * Vec3(0.02, 0.0, 0.0)).norm(), 0.0, 1e-12);
  const Vec3 moved_m = placed.read();
  placed.device.write({});
  EXPECT_NEAR((placed.read() - moved_m).norm(), 0.0, 1e-12) << "the tool stays";
  placed.table.put({0.02, 0.05, 0.03});
  EXPECT_NEAR((placed.read() - moved_m - turn * Vec3(0.0, 0.06, 0.0)).norm(), 0.0, 1e-12);
  placed.device.write({to_array(Vec3(turn * Vec3(0.0, 0.0, 1.0)))});
  EXPECT_NEAR((placed.table.force_N - Vec3(0.0, 0.0, 1.0)).norm(), 0.0, 1e-12) << "forces turn with it";
}

TEST(PlacedDevice, AClutchThatIsAskedForIsTheButtonOfTheDevice) {
  Placed placed(turned(2.0));
  placed.table.put({0.05, 0.0, 0.0}, messages::kGrabButton);
  const Vec3 before_m = placed.read();
  EXPECT_FALSE(placed.device.is_clutched());
  placed.device.ask_clutch(true);
  for (int tick = 0; tick < 100; ++tick) {
    placed.table.put({0.05 - 1e-3 * tick, 0.0, 0.0}, messages::kGrabButton);
    EXPECT_TRUE(placed.read().isApprox(before_m, 1e-12)) << tick;
  }
  EXPECT_TRUE(placed.device.is_clutched());
  EXPECT_EQ(placed.device.read(placed.now_ns).buttons, messages::kGrabButton | messages::kClutchButton);
  placed.device.ask_clutch(false);
  EXPECT_TRUE(placed.read().isApprox(before_m, 1e-12));
  EXPECT_FALSE(placed.device.is_clutched());
  placed.table.put({-0.039, 0.0, 0.0}, messages::kClutchButton);  // the device's own goes on working
  placed.read();
  EXPECT_TRUE(placed.device.is_clutched());
}

TEST(PlacedDevice, AClutchThatIsAskedForReachesTheGateWhateverThePositionIs) {
  Placed placed(turned(2.0));
  placed.table.put({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  placed.device.ask_clutch(true);
  EXPECT_EQ(placed.device.read(placed.now_ns).buttons, messages::kClutchButton);
}

Placement bubble(double radius_m) {
  Placement placement;
  placement.bubble_radius_m = radius_m;
  return placement;
}

TEST(PlacedDevice, OutsideTheBubbleTheWorkspaceMovesOnAndInsideItStays) {
  Placed placed(bubble(0.04));
  placed.table.put({0.0, 0.039, 0.0});
  const Vec3 inside_m = placed.read();
  for (int tick = 0; tick < 1000; ++tick) placed.read();
  EXPECT_EQ(placed.read(), inside_m);
  placed.table.put({0.0, 0.06, 0.0});  // half a radius out: 50 mm/s
  Vec3 before_m = placed.read();
  for (int tick = 0; tick < 1000; ++tick) placed.read();
  EXPECT_NEAR((placed.read() - before_m).y(), 0.05, 1e-3);
  placed.table.put({0.0, 10.0, 0.0});  // no faster than 0.3 m/s, however far out
  before_m = placed.read();
  for (int tick = 0; tick < 1000; ++tick) placed.read();
  EXPECT_NEAR((placed.read() - before_m).y(), 0.3, 1e-3);
}

TEST(PlacedDevice, TheBubbleRestsWhileTheDeviceIsLost) {
  Placed placed(bubble(0.04));
  placed.table.put({0.0, 0.08, 0.0});
  placed.table.is_connected = false;
  const Vec3 before_m = placed.read();
  for (int tick = 0; tick < 1000; ++tick) placed.read();
  EXPECT_EQ(placed.read(), before_m);
}

TEST(PlacedDevice, TheBubbleRestsWhileAForceIsFelt) {
  Placed placed(bubble(0.04));
  placed.table.put({0.08, 0.0, 0.0});
  placed.device.write({{-0.2, 0.0, 0.0}});
  const Vec3 before_m = placed.read();
  for (int tick = 0; tick < 1000; ++tick) placed.read();
  EXPECT_EQ(placed.read(), before_m);
  placed.device.write({{0.0, 0.0, 0.0}});
  placed.read();
  EXPECT_GT(placed.read().x(), before_m.x());
}

TEST(PlacedDevice, PassesOnWhatIsNoNumberAndForgetsIt) {
  Placed placed(turned(2.0));
  const Vec3 before_m = placed.read();
  placed.table.put(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(placed.read().allFinite());
  placed.table.put(Vec3::Zero());
  EXPECT_EQ(placed.read(), before_m);
}

TEST(PlacedDevice, RefusesWhatIsNoPlacement) {
  Table table;
  for (const double scale : {0.0, -1.0, 21.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(PlacedDevice(table, turned(scale)), std::invalid_argument) << scale;
  }
  EXPECT_THROW(PlacedDevice(table, bubble(2.0)), std::invalid_argument);
  Placement mirrored;
  mirrored.world_from_device(0, 0) = -1.0;
  EXPECT_THROW(PlacedDevice(table, mirrored), std::invalid_argument);
}

TEST(PlacedDevice, ATickAllocatesNothing) {
  Placed placed(bubble(0.04));
  placed.table.put({0.08, 0.0, 0.0}, messages::kClutchButton);
  const support::AllocationGuard guard;
  placed.read();
  placed.table.put({0.08, 0.0, 0.0});
  placed.read();
  placed.device.write({{0.1, 0.0, 0.0}});
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace
}  // namespace myotact::device
