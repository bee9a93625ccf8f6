#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "device/replay_device.h"
#include "device/simulated_device.h"
#include "haptics/effects/reported_contact.h"
#include "haptics/faults.h"
#include "haptics/haptic_loop.h"
#include "haptics/proxy/moving_surface.h"
#include "support/allocation_guard.h"

namespace myotact::haptics {
namespace {

constexpr double kExact_m = 1e-15;  // rounding of sums of millimetres
constexpr double kRadius_m = 3e-3;

messages::ReportedContact contact(const Vec3& point_m, const Vec3& normal_W, double penetration_m, int surface = 0) {
  return {surface, to_array(point_m), to_array(normal_W), penetration_m};
}

messages::ReportedContacts report(std::initializer_list<messages::ReportedContact> contacts) {
  messages::ReportedContacts reported;
  for (const messages::ReportedContact& c : contacts) reported.contacts[static_cast<std::size_t>(reported.count++)] = c;
  return reported;
}

/// n = (0.6, 0, 0.8). By hand: a step of (1, 5, 2) mm goes 0.6 + 1.6 = 2.2 mm along n, one of (-0.5, 0, -1) mm goes
/// -0.3 - 0.8 = -1.1 mm.
TEST(PenetrationMethod, CarriesTheReportedDepthOnAlongATiltedNormal) {
  const Vec3 n(0.6, 0.0, 0.8);
  PenetrationMethod method;
  Vec3 tool_m(0.1, 0.2, 0.3);
  method.move(tool_m);
  EXPECT_EQ(method.depenetration().bearing, -1);  // nothing reported yet
  method.take(report({contact(Vec3::Zero(), n, 1e-3)}));
  EXPECT_NEAR(method.depenetration().depth_m, 1e-3, kExact_m);
  method.move(tool_m += Vec3(-0.5e-3, 0.0, -1e-3));
  EXPECT_NEAR((method.depenetration().way_m - 2.1e-3 * n).norm(), 0.0, kExact_m);
  method.move(tool_m += Vec3(1e-3, 5e-3, 2e-3));  // 2.1 - 2.2: 0.1 mm out of it
  EXPECT_EQ(method.depenetration().way_m, Vec3::Zero());
  EXPECT_EQ(method.depenetration().bearing, -1);
  method.move(tool_m += Vec3(1e-3, 0.0, 2e-3));  // 2.3 mm out of it
  EXPECT_EQ(method.depenetration().way_m, Vec3::Zero());
  for (int i = 0; i < 3; ++i) method.move(tool_m += Vec3(-0.5e-3, 0.0, -1e-3));  // -2.3 + 3 * 1.1: it comes back
  EXPECT_NEAR(method.depenetration().depth_m, 1.0e-3, kExact_m);
  method.take(report({contact(Vec3::Zero(), n, 0.4e-3)}));  // the report counts, whatever was carried on
  EXPECT_NEAR(method.depenetration().depth_m, 0.4e-3, kExact_m);
  method.take(report({}));
  method.move(tool_m += Vec3(-0.5e-3, 0.0, -1e-3));
  EXPECT_EQ(method.depenetration().bearing, -1);  // what the engine does not report is not felt
}

Depenetration depenetration_at(PlaneMethod& method, const Vec3& tool_m) {
  method.move(tool_m);
  return method.depenetration();
}

/// The tilted plane n . x = 0.6 * 10 mm through (10, 0, 0) mm; a sphere of 3 mm round (10, 7, 3) mm stands 2.4 mm off
/// it with its middle and 0.6 mm in it with its lowest point.
TEST(PlaneMethod, IsTheDepthOfTheSpheresLowestPoint) {
  const Vec3 n(0.6, 0.0, 0.8);
  PlaneMethod method(kRadius_m);
  EXPECT_EQ(depenetration_at(method, Vec3::Zero()).bearing, -1);
  method.take(report({contact(Vec3(10e-3, 0, 0), n, 55.0)}));  // the reported depth is not asked for
  const Depenetration out = depenetration_at(method, Vec3(10e-3, 7e-3, 3e-3));
  EXPECT_EQ(out.bearing, 0);
  EXPECT_NEAR(out.depth_m, 0.6e-3, kExact_m);
  EXPECT_NEAR((out.way_m - 0.6e-3 * n).norm(), 0.0, kExact_m);
  EXPECT_EQ(depenetration_at(method, Vec3(10e-3, 0, 4e-3)).way_m, Vec3::Zero());              // 0.2 mm above it
  EXPECT_NEAR(depenetration_at(method, Vec3(10e-3, 0, -1e-3)).depth_m, 3.8e-3, kExact_m);     // middle under the plane
  EXPECT_NEAR(depenetration_at(method, Vec3(10e-3, -9e-3, 2e-3)).depth_m, 1.4e-3, kExact_m);  // and back
}

/// On a flat surface that rests, with reports of where the tool is now, the two methods are one. This engine reports
/// what is near, too.
TEST(ForceMethods, PenetrationAndPlaneAgreeOnAFlatSurface) {
  const Vec3 n = Vec3(-1.0, 2.0, 2.0) / 3.0;
  const Vec3 on_plane_m(0.02, -0.01, 0.005);
  PenetrationMethod a;
  PlaneMethod b(kRadius_m);
  int pressed = 0;
  for (int tick = 0; tick < 600; ++tick) {
    const double t = 1e-3 * tick;
    const Vec3 tool_m = on_plane_m + 0.05 * t * Vec3(2.0, 1.0, 0.0) + (kRadius_m + 4e-3 * std::cos(20.0 * t)) * n;
    const double depth_m = kRadius_m - n.dot(tool_m - on_plane_m);
    a.move(tool_m);
    if (tick % 17 == 0) {
      const Vec3 foot_m = tool_m - (kRadius_m - depth_m) * n;
      a.take(report({contact(foot_m, n, depth_m)}));
      b.take(report({contact(foot_m, n, depth_m)}));
    }
    EXPECT_NEAR((a.depenetration().way_m - std::max(0.0, depth_m) * n).norm(), 0.0, 1e-12) << tick;
    EXPECT_NEAR((depenetration_at(b, tool_m).way_m - a.depenetration().way_m).norm(), 0.0, 1e-12) << tick;
    pressed += a.depenetration().bearing >= 0;
  }
  EXPECT_GT(pressed, 100);
  EXPECT_LT(pressed, 500);
}

/// The jump that the method is known for: an engine that looked 16 ms ago at a hand that moves at 50 mm/s.
TEST(PenetrationMethod, JumpsWithAnOldReportAsPublished) {
  PenetrationMethod method;
  method.move(Vec3(0, 0, 0));
  method.take(report({contact(Vec3::Zero(), Vec3::UnitZ(), 1e-3)}));
  for (int tick = 1; tick <= 16; ++tick) method.move(Vec3(0, 0, -5e-5 * tick));
  EXPECT_NEAR(method.depenetration().depth_m, 1.8e-3, kExact_m);
  method.take(report({contact(Vec3::Zero(), Vec3::UnitZ(), 1e-3)}));
  EXPECT_NEAR(method.depenetration().depth_m, 1e-3, kExact_m);
}

/// Bullet, of a sphere on a flat mesh: the face, and the edge of the next triangle with a tilted normal.
TEST(PressedContacts, OneContactABodyTheDeepest) {
  PressedContacts pressed;
  pressed.take(report({contact(Vec3::Zero(), Vec3(0, 0.6, 0.8), 1e-3, 0), contact(Vec3::Zero(), Vec3::UnitZ(), 2e-3, 0),
                       contact(Vec3::Zero(), -Vec3::UnitX(), 1e-3, 7), contact(Vec3::Zero(), Vec3::UnitY(), 1e-3, 7)}));
  ASSERT_EQ(pressed.count(), 2);
  EXPECT_NEAR((pressed.depenetration().way_m - Vec3(-1e-3, 0, 2e-3)).norm(), 0.0, kExact_m);
  EXPECT_EQ(pressed.depenetration().bearing, 1);  // by its place in the report
  PlaneMethod plane(kRadius_m);
  plane.take(
      report({contact(Vec3::Zero(), Vec3(0, 0.6, 0.8), 1e-3, 0), contact(Vec3::Zero(), Vec3::UnitZ(), 2e-3, 0)}));
  EXPECT_NEAR((depenetration_at(plane, Vec3(0, 0, 1e-3)).way_m - Vec3(0, 0, 2e-3)).norm(), 0.0, kExact_m);
  EXPECT_EQ(depenetration_at(plane, Vec3(0, 0, 1e-3)).bearing, 1);
}

TEST(PressedContacts, AFacePressesOnceACornerTwiceASlotAgainstItself) {
  PressedContacts face;
  for (const double depth_m : {1e-3, 2e-3, 0.5e-3, 2e-3}) face.add({Vec3::UnitZ(), depth_m, face.count()});
  EXPECT_NEAR((face.depenetration().way_m - Vec3(0, 0, 2e-3)).norm(), 0.0, kExact_m);

  PressedContacts corner;
  corner.add({Vec3::UnitZ(), 1e-3, 0});
  corner.add({Vec3::UnitX(), 2e-3, 1});
  corner.add({Vec3::UnitY(), -1e-3, 2});
  EXPECT_NEAR((corner.depenetration().way_m - Vec3(2e-3, 0, 1e-3)).norm(), 0.0, kExact_m);
  EXPECT_EQ(corner.depenetration().bearing, 1);

  PressedContacts slot;
  slot.add({Vec3::UnitX(), 1e-3, 0});
  slot.add({-Vec3::UnitX(), 3e-3, 1});
  EXPECT_NEAR((slot.depenetration().way_m - Vec3(-2e-3, 0, 0)).norm(), 0.0, kExact_m);

  // 60 degrees: w1 + w2/2 = 1 and w1/2 + w2 = 1 mm, so both 2/3: by hand.
  PressedContacts edge;
  edge.add({Vec3::UnitZ(), 1e-3, 0});
  edge.add({Vec3(std::sqrt(0.75), 0.0, 0.5), 1e-3, 1});
  EXPECT_NEAR((edge.depenetration().way_m - Vec3(2e-3 / 3.0 * std::sqrt(0.75), 0.0, 1e-3)).norm(), 0.0, 1e-12);
}

/// Nothing jumps while the normals of a curved body come together, apart, or change places as the deepest.
TEST(PressedContacts, ChangesAsLittleAsTheContactsDo) {
  Vec3 last_m = Vec3::Zero();
  for (int i = 0; i <= 2000; ++i) {
    const double angle_rad = 1e-3 * (i - 1000);
    PressedContacts pressed;
    const PressedContact fixed{Vec3::UnitZ(), 1e-3, 0};
    const PressedContact turning{Vec3(std::sin(angle_rad), 0.0, std::cos(angle_rad)), 0.5e-3 + 0.5e-6 * i, 1};
    const bool turning_first = turning.depth_m > fixed.depth_m;  // the deepest first, as engines report
    pressed.add(turning_first ? turning : fixed);
    pressed.add(turning_first ? fixed : turning);
    const Vec3 way_m = pressed.depenetration().way_m;
    if (i > 0) {
      EXPECT_LT((way_m - last_m).norm(), 5e-6) << i;
    }
    last_m = way_m;
  }
}

TEST(PullingMethod, IsASpringToTheNewestPublishedPlace) {
  constexpr double k_N_m = 300.0;
  PullingMethod method({k_N_m, 0.5});
  messages::LocalModel model;
  model.grip.body = 4;
  model.grip.point_rest_m = {1, 2, 3};
  model.grip.position_world_m = {0.01, 0.0, 0.0};
  const Vec3 closed_m(0.015, 0.0, 0.002);
  EXPECT_EQ(method.tick(nullptr, closed_m, true, 3.0), Vec3::Zero());  // nothing known: nothing to hold
  EXPECT_EQ(method.body(), -1);
  method.tick(nullptr, closed_m, false, 3.0);
  EXPECT_EQ(method.tick(&model, closed_m, true, 3.0), Vec3::Zero());  // slack where the hand closes
  EXPECT_EQ(method.body(), 4);
  EXPECT_EQ(method.stiffness_N_m(), 600.0);
  // F = k0 (p_S - p_H): hand 3 mm along y, body not yet.
  const Vec3 moved_m(0.0, 3e-3, 0.0);
  EXPECT_NEAR((method.tick(&model, closed_m + moved_m, true, 3.0) + k_N_m * moved_m).norm(), 0.0, 1e-9);
  EXPECT_NEAR((method.target_m() - (Vec3(0.01, 0, 0) + moved_m)).norm(), 0.0, 1e-12);
  model.grip.position_world_m = {0.011, 0.002, 0.0};  // the body follows
  model.grip.velocity_world_m_s = {1, 1, 1};          // which predicts nothing
  EXPECT_NEAR((method.tick(&model, closed_m + moved_m, true, 3.0) - k_N_m * Vec3(1e-3, -1e-3, 0)).norm(), 0.0, 1e-9);
  model.grip.point_rest_m = {9, 9, 9};  // of another point: held
  model.grip.position_world_m = {0.5, 0.5, 0.5};
  EXPECT_NEAR((method.tick(&model, closed_m + moved_m, true, 3.0) - k_N_m * Vec3(1e-3, -1e-3, 0)).norm(), 0.0, 1e-9);
  // More than the device gives: cut, and the simulation gets as much over the force scale.
  const Vec3 cut_N = method.tick(&model, closed_m + Vec3(0, 0, 0.1), true, 3.0);
  EXPECT_NEAR(cut_N.norm(), 3.0, 1e-9);
  const Vec3 on_body_N = method.stiffness_N_m() * (method.target_m() - Vec3(0.011, 0.002, 0.0));
  EXPECT_NEAR((on_body_N + cut_N / 0.5).norm(), 0.0, 1e-9);
  EXPECT_EQ(method.tick(&model, closed_m, false, 3.0), Vec3::Zero());
  EXPECT_EQ(method.stiffness_N_m(), 0.0);
  EXPECT_EQ(method.tick(&model, closed_m, false, 3.0), Vec3::Zero());
  EXPECT_EQ(method.body(), -1);
}

TEST(MovingSurface, AReportWithoutNumbersMakesAModelUnsound) {
  messages::LocalModel model;
  model.reported = report({contact(Vec3::Zero(), Vec3::UnitZ(), 1e-3)});
  EXPECT_TRUE(is_sound(model));
  model.reported.contacts[0].penetration_m = std::nan("");
  EXPECT_FALSE(is_sound(model));
  model.reported.count = 0;
  EXPECT_TRUE(is_sound(model));  // what is not in the list is not read
  model.reported.tool_world_m[1] = std::nan("");
  EXPECT_FALSE(is_sound(model));
  for (const int count : {-1, messages::kMaxReportedContacts + 1}) {
    model.reported = {};
    model.reported.count = count;
    EXPECT_FALSE(is_sound(model));
  }
}

/// A loop over a floor at z = 0 that is known from reports alone, always as new as the tool's place.
class FloorLoop {
 public:
  explicit FloorLoop(ForceMethod method) : loop_(device_, settings(method)) {
    device_.set_hand_target({{0, 0, 0.01}, {}, 0});
    loop_.prepare(now_ns_);
  }

  void tick(const Vec3& hand_m) {
    device_.set_hand_target({to_array(hand_m), {}, 0});
    if (tick_++ % 17 == 0) publish();
    now_ns_ += kTickPeriod_ns;
    loop_.tick(now_ns_);
  }
  void publish() {
    messages::LocalModel& model = loop_.models().back();
    model = {};
    const Vec3 tool_m = to_vec3(loop_.tool_state().tool_position_world_m);
    model.reported = report({contact({tool_m.x(), tool_m.y(), 0.0}, Vec3::UnitZ(), kRadius_m - tool_m.z(), 6)});
    model.sequence = ++sequence_;
    model.published_at_ns = now_ns_;
    model.dt_ns = 17 * kTickPeriod_ns;
    loop_.models().publish();
  }
  HapticLoop& loop() { return loop_; }
  const device::SimulatedDevice& device() const { return device_; }

 private:
  static HapticSettings settings(ForceMethod method) {
    HapticSettings settings;
    settings.method = method;
    settings.gate.ramp_s = 0.1;
    return settings;
  }
  device::SimulatedDevice device_{"simulated", Vec3(0, 0, 0.01)};
  HapticLoop loop_;
  std::uint64_t now_ns_ = kTickPeriod_ns, sequence_ = 0;
  int tick_ = 0;
};

TEST(PullingMethod, ATickOfItsLoopNeverAllocates) {
  HapticSettings settings;
  settings.method = ForceMethod::Pulling;
  settings.gate.ramp_s = 0.1;
  device::SimulatedDevice device("simulated", Vec3(0, 0, 0.02));
  HapticLoop loop(device, settings);
  loop.prepare(kTickPeriod_ns);
  std::uint64_t allocations = 0;
  double most_N = 0.0;
  for (std::uint64_t tick = 1; tick <= 500; ++tick) {
    if (tick % 17 == 1) {
      loop.models().back() = {};
      loop.models().back().grip.body = 2;
      loop.models().back().published_at_ns = tick * kTickPeriod_ns;
      loop.models().back().dt_ns = 17 * kTickPeriod_ns;
      loop.models().publish();
    }
    device.set_hand_target({{0, 0, tick > 200 ? 0.025 : 0.02}, {}, tick > 200 ? messages::kGrabBoneButton : 0u});
    const support::AllocationGuard guard;
    loop.tick(tick * kTickPeriod_ns);
    allocations += guard.allocations();
    most_N = std::max(most_N, to_vec3(loop.tool_state().force_world_N).norm());
  }
  EXPECT_EQ(allocations, 0u);
  EXPECT_GT(most_N, 0.5);
  EXPECT_EQ(loop.tool_state().grabbed_body, 2);
}

class FeltByReports : public ::testing::TestWithParam<ForceMethod> {};

TEST_P(FeltByReports, AFloorIsASpringAndTheEngineIsToldOfIt) {
  FloorLoop floor(GetParam());
  for (int i = 0; i < 200; ++i) floor.tick(Vec3(0, 0, 0.01));
  std::uint64_t allocations = 0;
  for (int i = 0; i < 600; ++i) {
    floor.publish();
    const support::AllocationGuard guard;
    floor.tick(Vec3(1e-3, 0, -1e-3));
    allocations += guard.allocations();
  }
  EXPECT_EQ(allocations, 0u);
  const messages::ToolState& tool = floor.loop().tool_state();
  const ContactSettings defaults;
  const double depth_m = kRadius_m - tool.tool_position_world_m[2];
  EXPECT_GT(depth_m, 0.5e-3);
  EXPECT_NEAR(tool.force_world_N[2], defaults.stiffness_N_m * depth_m, 1e-9);
  EXPECT_EQ(tool.faults, 0u);
  EXPECT_EQ(tool.contact.surface, 6);
  EXPECT_EQ(tool.contact.triangle, -1);
  EXPECT_NEAR(tool.touched_world_m[2], 0.0, 1e-12);
  EXPECT_NEAR(tool.proxy_position_world_m[2], kRadius_m, 1e-12);
  const Vec3 on_body_N =
      tool.contact.stiffness_N_m * (to_vec3(tool.contact.target_world_m) - to_vec3(tool.touched_world_m));
  EXPECT_NEAR((on_body_N + to_vec3(tool.force_world_N)).norm(), 0.0, 1e-9);
  EXPECT_LE(floor.loop().ports().missing_J(), 0.1e-3);
}

TEST_P(FeltByReports, NoForceBeyondTheDevicesShareAndNoneWithoutReports) {
  FloorLoop floor(GetParam());
  for (int i = 0; i < 200; ++i) floor.tick(Vec3(0, 0, 0.01));
  double most_N = 0.0;
  for (int i = 0; i < 600; ++i) {
    floor.tick(Vec3(0, 0, -0.04));
    most_N = std::max(most_N, to_vec3(floor.loop().tool_state().force_world_N).norm());
  }
  const device::DeviceProfile profile;
  EXPECT_LE(most_N, 0.5 * profile.peak_force_N + 1e-12);
  EXPECT_GT(most_N, 0.45 * profile.peak_force_N);
  messages::LocalModel& model = floor.loop().models().back();
  model = {};
  floor.loop().models().publish();
  floor.loop().tick(10'000'000'000);
  EXPECT_EQ(floor.loop().tool_state().force_world_N[2], 0.0);
  EXPECT_EQ(floor.loop().tool_state().contact.surface, -1);
}

INSTANTIATE_TEST_SUITE_P(Methods, FeltByReports, ::testing::Values(ForceMethod::Penetration, ForceMethod::Plane),
                         [](const auto& which) { return which.param == ForceMethod::Plane ? "Plane" : "Penetration"; });

}  // namespace
}  // namespace myotact::haptics
