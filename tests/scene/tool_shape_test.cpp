// What the shapes of tools feel like: from the scene's setting to the force on the hand.

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "device/simulated_device.h"
#include "geometry/plain_surfaces.h"
#include "scene/lockstep_haptics.h"
#include "simulation/touch/local_patch.h"

namespace myotact::scene {
namespace {

constexpr std::uint64_t kTick_ns = haptics::kTickPeriod_ns;

/// A hand over a resting surface that is shown once every 10 ticks.
class Touch {
 public:
  Touch(const ToolSettings& tool, const geometry::TriangleMesh& mesh, const Vec3& start_m)
      : device("simulated", start_m), loop(device, haptic_settings(tool)), mesh_(mesh), patch_(patch_of(mesh)) {
    patch_.update_surface(0, mesh_.positions_m, mesh_.positions_m);
    loop.prepare(now_ns_);
  }

  /// The hand wants to be there for so long; a line and a bone are within reach of it.
  void hold(const Vec3& target_m, std::uint32_t buttons, int ticks) {
    device.set_hand_target({to_array(target_m), {}, buttons});
    for (int i = 0; i < ticks; ++i) {
      if (i % 10 == 0) publish();
      loop.tick(now_ns_ += kTick_ns);
    }
  }
  const messages::ToolState& tool() const { return loop.tool_state(); }

  device::SimulatedDevice device;
  haptics::HapticLoop loop;

 private:
  static simulation::LocalPatch patch_of(const geometry::TriangleMesh& mesh) {
    const std::array<const geometry::TriangleMesh*, 1> surfaces = {&mesh};
    return simulation::LocalPatch(surfaces);
  }
  void publish() {
    messages::LocalModel& model = loop.models().back();
    model = {};
    patch_.write(to_vec3(tool().proxy_position_world_m), model);
    model.sequence = ++sequence_;
    model.published_at_ns = now_ns_;
    model.dt_ns = 10 * kTick_ns;
    model.line = {0, 0.5, {0, 0, 0.05}, {-0.1, 0, 0.05}, {0.1, 0, 0.05}, 5.0, 0.2, 100.0, 0.0};
    model.grip.body = 0;
    model.grip.point_rest_m = model.grip.position_world_m = {0, 0, 0.05};
    loop.models().publish();
  }

  geometry::TriangleMesh mesh_;
  simulation::LocalPatch patch_;
  std::uint64_t now_ns_ = kTick_ns, sequence_ = 0;
};

ToolSettings shaped(messages::ToolShape shape, double radius_m) {
  ToolSettings tool;
  tool.shape = shape;
  tool.radius_m = radius_m;
  tool.static_friction = tool.dynamic_friction = 0.0;
  return tool;
}

// A sphere of radius r comes to rest r / sin(half the angle) above the bottom of a V groove: the point of a stylus goes
// in where a fingertip is held off.
TEST(ToolShape, APointGoesIntoAGrooveThatHoldsAFingertipOff) {
  const double half_angle_rad = std::numbers::pi / 12.0;
  const geometry::TriangleMesh groove = geometry::make_groove(2.0 * half_angle_rad, 0.04, 16);
  std::array<double, 2> tip_m{};
  for (const bool point : {true, false}) {
    const double radius_m = point ? 0.5e-3 : 3e-3;
    Touch touch(shaped(point ? messages::ToolShape::Point : messages::ToolShape::Ball, radius_m), groove,
                Vec3(0, 0, 0.045));
    for (int i = 0; i <= 48; ++i) touch.hold(Vec3(0, 0, 0.045 - 0.001 * i), 0, 50);
    const double height_m = touch.tool().proxy_position_world_m[2];
    EXPECT_NEAR(height_m, radius_m / std::sin(half_angle_rad), 0.05 * radius_m);
    tip_m[point ? 0 : 1] = height_m - radius_m;
  }
  EXPECT_LT(tip_m[0], tip_m[1] - 5e-3);
}

TEST(ToolShape, AClampTakesBonesWithEitherButtonAndNoLine) {
  const geometry::TriangleMesh plane = geometry::make_plane(0.06, 4);
  const Vec3 above_m(0, 0, 0.05);
  for (const std::uint32_t button : {messages::kGrabButton, messages::kGrabBoneButton}) {
    Touch clamp(shaped(messages::ToolShape::Clamp, 6e-3), plane, above_m);
    Touch ball(shaped(messages::ToolShape::Ball, 6e-3), plane, above_m);
    for (Touch* touch : {&clamp, &ball}) {
      touch->hold(above_m, 0, 1200);
      touch->hold(above_m, button, 300);
    }
    EXPECT_EQ(clamp.tool().grabbed_body, 0);
    EXPECT_EQ(clamp.tool().grabbed_line, -1);
    EXPECT_EQ(ball.tool().grabbed_body, button == messages::kGrabBoneButton ? 0 : -1);
    EXPECT_EQ(ball.tool().grabbed_line, button == messages::kGrabButton ? 0 : -1);
  }
}

}  // namespace
}  // namespace myotact::scene
