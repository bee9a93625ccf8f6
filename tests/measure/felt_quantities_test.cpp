// Stiffness, friction and a joint's K out of runs whose forces are synthetic: what was planted must be found, and where
// nothing can be said nothing is.

#include "measure/fidelity/felt_quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/plain_surfaces.h"

namespace myotact::measure {
namespace {

constexpr double kTickOfRun_s = 1e-3;

/// A run with the series that belongs to it, made tick by tick.
struct MadeRun {
  DeviceRun run;
  ForceSeries series;

  haptics::HapticTick& add(const Vec3& place_m, const Vec3& commanded_N, const Vec3& true_N, bool compared = true) {
    haptics::HapticTick& tick = run.ticks.emplace_back();
    tick.device.stylus_position_world_m = to_array(place_m);
    tick.gate = haptics::GateState::On;
    series.hand_m.push_back(place_m);
    series.commanded_N.push_back(commanded_N);
    series.true_N.push_back(true_N);
    series.compared.push_back(compared);
    return tick;
  }
};

Vec3 any_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3::NullaryExpr([&] { return normal(random); }).normalized();
}

struct MadePress {
  Vec3 normal = Vec3::UnitZ();
  double felt_N_m = 0.0, true_N_m = 0.0;
  double depth_m = 3e-3;
  double lean = 0.0;  // way along the surface over way into it
};

/// In the air, half a second into the surface, the same time out of it, in the air.
void add_press(const MadePress& press, MadeRun& made) {
  const Vec3 along = press.normal.unitOrthogonal();
  for (int i = -100; i < 1100; ++i) {
    const double depth_m = press.depth_m * (1.0 - std::abs(i - 500) / 500.0);
    const double lean_m = press.lean * press.depth_m * std::clamp(i / 500.0, 0.0, 1.0);
    const Vec3 place_m = Vec3(0.1, 0.2, 0.3) - depth_m * press.normal + lean_m * along;
    const double touched_m = std::max(0.0, depth_m);
    const Vec3 friction_N = 0.2 * touched_m * press.true_N_m * along;  // across the normal: no part of a stiffness
    haptics::HapticTick& tick = made.add(place_m, press.felt_N_m * touched_m * press.normal - friction_N,
                                         press.true_N_m * touched_m * press.normal - friction_N);
    if (depth_m < 0.0) continue;
    tick.tool.contact.surface = 0;
    tick.tool.contact.normal_world = to_array(press.normal);
  }
}

TEST(PressStiffness, IsTheSlopeOfEachForceWhicheverWayThePressGoes) {
  std::mt19937 random(121);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  MadeRun made;
  std::vector<MadePress> presses;
  for (int round = 0; round < 20; ++round) {
    presses.push_back({any_direction(random), 100.0 + 900.0 * uniform(random), 100.0 + 900.0 * uniform(random),
                       1e-3 + 9e-3 * uniform(random), 0.8 * uniform(random)});
    add_press(presses.back(), made);
  }
  const std::vector<PressStiffness> found = press_stiffness(made.run, made.series);
  ASSERT_EQ(found.size(), presses.size());
  for (std::size_t k = 0; k < presses.size(); ++k) {
    EXPECT_NEAR(found[k].felt_N_m, presses[k].felt_N_m, 1e-6 * presses[k].felt_N_m) << k;
    EXPECT_NEAR(found[k].true_N_m, presses[k].true_N_m, 1e-6 * presses[k].true_N_m) << k;
    EXPECT_NEAR(found[k].depth_m, 0.9 * presses[k].depth_m, 0.01 * presses[k].depth_m) << k;
    EXPECT_NEAR(found[k].start_s, 1e-3 * (100.0 + 1200.0 * static_cast<double>(k)), 1e-9) << k;
  }
}

TEST(PressStiffness, LightTouchesStrokesAndWhatIsInHandAreNone) {
  const auto found = [](const MadePress& press, auto&& change) {
    MadeRun made;
    add_press(press, made);
    for (std::size_t i = 0; i < made.run.ticks.size(); ++i) change(made, i);
    return press_stiffness(made.run, made.series).size();
  };
  const auto nothing = [](MadeRun&, std::size_t) {};
  const MadePress sound{Vec3::UnitZ(), 300.0, 300.0, 3e-3, 0.0};
  EXPECT_EQ(found(sound, nothing), 1u);
  EXPECT_EQ(found({Vec3::UnitZ(), 300.0, 30.0, 3e-3, 0.0}, nothing), 0u);    // 90 mN
  EXPECT_EQ(found({Vec3::UnitZ(), 300.0, 3000.0, 4e-4, 0.0}, nothing), 0u);  // 0.28 mm between a fifth and nine tenths
  EXPECT_EQ(found({Vec3::UnitZ(), 300.0, 300.0, 3e-3, 3.0}, nothing), 0u);   // a stroke
  EXPECT_EQ(found(sound, [](MadeRun& made, std::size_t i) { made.run.ticks[i].tool.grabbed_body = 1; }), 0u);
  EXPECT_EQ(found(sound, [](MadeRun& made, std::size_t i) { made.run.ticks[i].tool.grabbed_line = 0; }), 0u);
  EXPECT_EQ(found(sound, [](MadeRun& made, std::size_t i) { made.series.compared[i] = false; }), 0u);
}

/// A scene of one flat skin of 40 mm, on which a tool can slide for a while.
scene::Scene sliding_scene() {
  scene::Scene scene;
  scene.specimen.muscles.resize(1);
  scene.specimen.muscles[0].skin = geometry::make_plane(0.04, 1);
  scene.tools.resize(1);
  scene.tools[0].static_friction = 0.5;
  scene.tools[0].dynamic_friction = 0.2;
  scene.tools[0].stribeck_m_s = 0.02;
  return scene;
}

/// Slides over one triangle of that skin, to and fro, at an even speed.
void add_slide(const scene::Scene& scene, double speed_m_s, double felt, double simulated, int ticks, MadeRun& made) {
  const geometry::TriangleMesh& skin = scene.specimen.muscles[0].skin;
  const std::array<int, 3>& corners = skin.triangles[0];
  const Vec3 side_m =
      skin.positions_m[static_cast<std::size_t>(corners[1])] - skin.positions_m[static_cast<std::size_t>(corners[0])];
  std::mt19937 random(122);
  std::uniform_real_distribution<double> uniform(0.2, 2.0);
  for (int i = 0; i < ticks; ++i) {
    const double cycle = std::fmod(speed_m_s * kTickOfRun_s * i / side_m.norm(), 2.0);
    const double share = cycle < 1.0 ? cycle : 2.0 - cycle;
    const Vec3 along = side_m.normalized();
    const double pressed_N = uniform(random), commanded_N = uniform(random);
    haptics::HapticTick& tick = made.add(Vec3::Zero(), commanded_N * (Vec3::UnitZ() - felt * along),
                                         pressed_N * (Vec3::UnitZ() - simulated * along));
    tick.tool.contact.surface = 0;
    tick.tool.contact.triangle = 0;
    tick.tool.contact.barycentric = {1.0 - share, share, 0.0};
    tick.tool.contact.normal_world = {0.0, 0.0, 1.0};
  }
}

TEST(SlidingFriction, IsWhatWasPlantedBesideWhatTheSceneAsksFor) {
  const scene::Scene scene = sliding_scene();
  for (const double speed_m_s : {0.006, 0.02, 0.05, 0.3}) {
    MadeRun made;
    add_slide(scene, speed_m_s, 0.27, 0.31, 2000, made);
    const auto found = sliding_friction(scene, made.run, made.series);
    ASSERT_TRUE(found) << speed_m_s;
    EXPECT_NEAR(found->felt, 0.27, 1e-9);
    EXPECT_NEAR(found->simulated, 0.31, 1e-9);
    // Stribeck's curve; where the way turns, the window of 50 ms is no longer straight, but as long.
    const double asked = 0.2 + 0.3 * std::exp(-std::pow(speed_m_s / 0.02, 2));
    EXPECT_NEAR(found->asked, asked, 0.01 * asked) << speed_m_s;
    EXPECT_GE(found->ticks, 1900u);
  }
}

TEST(SlidingFriction, StickingShortAndDirectedOnesSayNothing) {
  scene::Scene scene = sliding_scene();
  MadeRun slow, brief, sound;
  add_slide(scene, 0.004, 0.3, 0.3, 2000, slow);
  add_slide(scene, 0.05, 0.3, 0.3, 90, brief);  // 40 ticks after the first window
  add_slide(scene, 0.05, 0.3, 0.3, 2000, sound);
  EXPECT_FALSE(sliding_friction(scene, slow.run, slow.series));
  EXPECT_FALSE(sliding_friction(scene, brief.run, brief.series));
  EXPECT_TRUE(sliding_friction(scene, sound.run, sound.series));
  MadeRun hops = sound;  // off the surface for a tick of every 40: never a whole window on it
  for (std::size_t i = 0; i < hops.run.ticks.size(); i += 40) hops.run.ticks[i].tool.contact = {};
  EXPECT_FALSE(sliding_friction(scene, hops.run, hops.series));
  scene.tools[0].along_over_across = 0.5;
  EXPECT_FALSE(sliding_friction(scene, sound.run, sound.series));
  scene.tools[0].along_over_across = 1.0;
  scene.tools[0].viscous_Ns_m = 0.1;
  EXPECT_FALSE(sliding_friction(scene, sound.run, sound.series));
}

struct MadeJoint {
  double K_Nm_rad = 4.0, B_Nms_rad = 0.3, constant_Nm = 0.2;
  double swing_rad = 0.1;
  double K_wanders = 0.0;  // share of the K that is read, either way
};

/// A bone in hand swings a joint of any axis, 10 ticks a step; the force has a part along the arm that rotates nothing.
std::optional<JointInHand> found_joint(const MadeJoint& joint, unsigned seed, bool in_hand = true) {
  std::mt19937 random(seed);
  scene::Scene scene;
  scene.tools.resize(1);
  scene.tools[0].force_scale = 1.7;
  scene.co_contraction.emplace();
  scene.co_contraction->joint = 0;
  scene.specimen.joints.resize(1);
  scene.specimen.joints[0].axes = {any_direction(random)};
  scene.specimen.joints[0].centre_m = 0.1 * any_direction(random);
  const Vec3& axis = scene.specimen.joints[0].axes[0];
  const Vec3 arm_m = 0.15 * any_direction(random), sideways = axis.cross(arm_m);
  MadeRun made;
  for (std::size_t i = 0; i < 3000; ++i) {
    const std::size_t step = i / 10;
    const double t = 0.01 * static_cast<double>(step), omega = 3.0;
    simulation::JointReadout readout;
    readout.angle_rad = joint.swing_rad * std::sin(omega * t);
    readout.velocity_rad_s = joint.swing_rad * omega * std::cos(omega * t);
    readout.stiffness_Nm_rad = 5.0 * (1.0 + joint.K_wanders * std::sin(2.2 * t));
    if (i % 10 == 0) made.run.joints.push_back(readout);
    made.run.step_of_tick.push_back(step);
    const double torque_Nm =
        joint.K_Nm_rad * readout.angle_rad + joint.B_Nms_rad * readout.velocity_rad_s + joint.constant_Nm;
    const Vec3 hand_N = 1.7 * torque_Nm * sideways / sideways.squaredNorm() + 2.0 * arm_m;
    made.add(scene.specimen.joints[0].centre_m + arm_m, -hand_N, -hand_N).tool.grabbed_body = in_hand ? 1 : -1;
  }
  return joint_in_hand(scene, made.run, made.series);
}

TEST(JointInHandFit, KIsTheHandsTorqueOverTheAngleWithoutSpeedAndWeight) {
  for (const unsigned seed : {131U, 132U, 133U, 134U, 135U}) {
    for (const double K_Nm_rad : {0.3, 4.0, 25.0, -2.0}) {
      const auto found = found_joint({K_Nm_rad, 0.3, -0.7, 0.1, 0.0}, seed);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->felt_Nm_rad, K_Nm_rad, 1e-6);
      EXPECT_NEAR(found->read_Nm_rad, 5.0, 1e-9);
      EXPECT_NEAR(found->range_rad, 0.2, 1e-3);
    }
  }
}

TEST(JointInHandFit, SaysNothingOfAJointThatHardlyTurnsChangesOrIsNotHeld) {
  EXPECT_FALSE(found_joint({4.0, 0.3, 0.2, 0.004, 0.0}, 136));  // 0.46 degrees
  EXPECT_TRUE(found_joint({4.0, 0.3, 0.2, 0.005, 0.0}, 136));
  EXPECT_FALSE(found_joint({4.0, 0.3, 0.2, 0.1, 0.04}, 136));
  EXPECT_TRUE(found_joint({4.0, 0.3, 0.2, 0.1, 0.02}, 136));
  EXPECT_FALSE(found_joint({}, 136, false));
}

}  // namespace
}  // namespace myotact::measure
