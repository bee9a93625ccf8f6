// A block of soft tissue under the tool: both engines.

#include <cmath>

#include "core/error.h"
#include "device/simulated_device.h"
#include "layer/engine_rig.h"
#include "layer/lockstep_layer.h"

namespace myotact::layer {
namespace {

using namespace testing;

class EngineTissue : public BothEngines {};
INSTANTIATE_TEST_SUITE_P(, EngineTissue, ::testing::Values(Kind::Bullet, Kind::Simulation),
                         [](const auto& kind) { return kind.param == Kind::Bullet ? "bullet" : "myotact"; });

constexpr double kTop_m = 0.03;  // of the pad

/// How deep the middle of the pad's upper face is, where a spring of 500 N/m wants it 4 mm deep.
struct Press {
  double depth_m = 0.0;
  double force_N = 0.0;
};

Press press(Engine& engine, int steps) {
  messages::ToolState tool = tool_at({0.0, 0.0, kTop_m + kRadius_m - 1e-4});
  tool.contact.surface = 0;  // no triangle named: the place alone
  tool.contact.normal_world = {0.0, 0.0, 1.0};
  tool.contact.stiffness_N_m = 500.0;
  const double wanted_m = kTop_m - 0.004;
  tool.contact.target_world_m = {0.0, 0.0, wanted_m};
  Press result;
  for (int step = 0; step < steps; ++step) {
    tool.touched_world_m = {0.0, 0.0, kTop_m - result.depth_m};
    engine.move_tool(0, tool);
    engine.advance();
    messages::LocalModel model;
    engine.write_surface(0, model);
    double lowest_m = kTop_m;
    for (std::size_t v = 0; v < static_cast<std::size_t>(model.vertex_count); ++v) {
      const Vec3 x = to_vec3(model.current_world_m[v]);
      if (x.head<2>().norm() < 1e-3) lowest_m = std::min(lowest_m, x.z());
    }
    result.depth_m = kTop_m - lowest_m;
  }
  result.force_N = 500.0 * (0.004 - result.depth_m);
  return result;
}

TEST_P(EngineTissue, a_press_comes_to_rest) {
  const auto engine = make_engine(GetParam(), plain_specimen("pad"), Vec3::Zero());
  const Press soon = press(*engine, 60), later = press(*engine, 30);
  EXPECT_GT(later.depth_m, 5e-4);
  EXPECT_LT(later.depth_m, 3.9e-3);
  EXPECT_NEAR(later.depth_m, soon.depth_m, 2e-5);
}

/// How far the middle of the upper face goes sideways under its weight, gravity along y.
double leaning_m(Engine& engine) {
  for (int step = 0; step < 90; ++step) engine.advance();
  engine.move_tool(0, tool_at({0.0, 0.0, kTop_m + kRadius_m}));
  messages::LocalModel model;
  engine.write_surface(0, model);
  double aside_m = 0.0, nearest_m = 2e-3;  // the next vertices are 6 mm away
  for (std::size_t v = 0; v < static_cast<std::size_t>(model.vertex_count); ++v) {
    const Vec3 x = to_vec3(model.current_world_m[v]);
    const double away_m = std::hypot(x.x(), x.y(), x.z() - kTop_m);
    if (away_m >= nearest_m) continue;
    nearest_m = away_m;
    aside_m = x.y();
  }
  return aside_m;
}

/// An endless layer of shear stiffness mu leans by rho g H^2 / (2 mu) at its top: 0.47 mm. The block is short, so that
/// it bends, too, and leans by some more.
TEST_P(EngineTissue, the_pad_leans_as_far_as_its_shear_stiffness_says) {
  const auto engine = make_engine(GetParam(), plain_specimen("pad"), kGravity_m_s2 * Vec3::UnitY());
  const double layer_m = 1060.0 * kGravity_m_s2 * kTop_m * kTop_m / (2.0 * 10e3);
  const double leans_m = leaning_m(*engine);
  EXPECT_GT(leans_m, layer_m);
  EXPECT_LT(leans_m, 1.5 * layer_m);
}

TEST_P(EngineTissue, a_sphere_on_the_pad_is_reported_as_deep_as_it_is) {
  const auto engine = make_engine(GetParam(), plain_specimen("pad"), Vec3::Zero());
  const auto reported = report_at(*engine, {0.004, 0.001, kTop_m + kRadius_m - 1e-3});
  ASSERT_GE(reported.count, 1);
  EXPECT_EQ(reported.contacts[0].surface, 0);
  EXPECT_NEAR(reported.contacts[0].penetration_m, 1e-3, 1e-9);
  EXPECT_NEAR(reported.contacts[0].normal_world[2], 1.0, 1e-9);
}

/// Loop, gate, device and hand on the tissue: pressed with 1 N, it stays calm.
TEST(BulletTissue, a_hand_that_presses_through_the_layer_stays_calm) {
  if (!has_bullet()) GTEST_SKIP() << "built without Bullet (libbullet-dev)";
  const auto engine = make_engine(Kind::Bullet, plain_specimen("pad"), Vec3::Zero());
  device::SimulatedDevice device("simulated", {0.0, 0.0, 0.05});
  LayerTool tool{&device, {}};
  tool.settings.contact.radius_m = kRadius_m;
  tool.settings.contact.static_friction = tool.settings.contact.dynamic_friction = 0.0;
  LockstepLayer layer(*engine, {&tool, 1});
  double low_N = 1e9, high_N = 0.0;
  for (int tick = 0; tick < 4000; ++tick) {
    const double down = std::min(1.0, std::max(0.0, (tick - 1500) / 500.0));
    device.set_hand_target({{0.0, 0.0, 0.05 - down * (0.05 - kTop_m - kRadius_m + 0.006)}, {}, 0});
    layer.tick();
    if (tick < 3000) continue;
    const double force_N = layer.loop(0).tool_state().force_world_N[2];
    low_N = std::min(low_N, force_N);
    high_N = std::max(high_N, force_N);
  }
  EXPECT_GT(low_N, 0.3);
  EXPECT_LT(high_N - low_N, 0.05);  // two counts of the encoder
}

TEST_P(EngineTissue, the_same_calls_give_the_same_bits) {
  std::array<double, 2> depths_m{};
  for (double& depth_m : depths_m) {
    depth_m = press(*make_engine(GetParam(), plain_specimen("pad"), kDown_m_s2), 20).depth_m;
  }
  EXPECT_EQ(depths_m[0], depths_m[1]);
}

TEST(BulletTissue, what_hangs_on_a_moving_body_is_refused) {
  if (!has_bullet()) GTEST_SKIP() << "built without Bullet (libbullet-dev)";
  EXPECT_THROW(make_bullet_engine(plain_specimen("canine_elbow")), Error);
}

}  // namespace
}  // namespace myotact::layer
