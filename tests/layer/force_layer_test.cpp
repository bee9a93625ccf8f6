#include "layer/force_layer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "device/replay_device.h"
#include "device/simulated_device.h"
#include "floor_engine.h"
#include "haptics/faults.h"
#include "layer/lockstep_layer.h"

namespace myotact::layer {
namespace {

using haptics::ForceMethod;

constexpr double kStiffness_N_m = 800.0;

/// A plain spring without friction and damping, so that closed forms are short.
haptics::HapticSettings plain(ForceMethod method) {
  haptics::HapticSettings settings;
  settings.method = method;
  settings.contact.radius_m = kRadius_m;
  settings.contact.stiffness_N_m = kStiffness_N_m;
  settings.contact.static_friction = settings.contact.dynamic_friction = 0.0;
  settings.contact.damping_Ns_m = 0.0;
  settings.gate.ramp_s = 0.1;
  return settings;
}

std::vector<messages::DeviceState> states_of(const std::vector<Vec3>& path_m, std::uint32_t buttons = 0) {
  std::vector<messages::DeviceState> states;
  for (const Vec3& p_m : path_m) {
    states.push_back({to_array(p_m), {}, 0, states.size() < 200 ? 0 : buttons});
  }
  return states;
}

/// Waits above the floor while the gate opens, comes down at 11 mm/s to 1.2 mm below, slides at 50 mm/s and sinks on.
std::vector<Vec3> press_and_slide() {
  std::vector<Vec3> path_m;
  for (int tick = 0; tick < 800; ++tick) {
    const double pressed_s = 1e-3 * std::clamp(tick - 200, 0, 200);
    const double slid_s = 1e-3 * std::max(0, tick - 400);
    path_m.emplace_back(0.05 * slid_s, 0.0, 4e-3 - 11e-3 * pressed_s - 0.5e-3 * slid_s);
  }
  return path_m;
}

/// What the tool must feel of a floor that rests at z = 0: from the definition of the method, tick by tick.
class Expected {
 public:
  explicit Expected(ForceMethod method) : method_(method) {}

  double force_N(const std::vector<Vec3>& path_m, std::size_t tick, bool new_report) {
    const double z_m = path_m[tick].z();
    if (new_report) {  // of where the tool was in the tick before
      reported_m_ = kRadius_m - path_m[tick - 1].z();
      taken_at_m_ = z_m;
    }
    if (method_ == ForceMethod::Proxy) return kStiffness_N_m * std::max(0.0, kRadius_m - z_m);
    if (!(reported_m_ >= 0.0)) return 0.0;
    const double depth_m = method_ == ForceMethod::Plane ? kRadius_m - z_m : reported_m_ - (z_m - taken_at_m_);
    return kStiffness_N_m * std::max(0.0, depth_m);
  }

 private:
  ForceMethod method_;
  double reported_m_ = -1.0, taken_at_m_ = 0.0;
};

class ByMethod : public ::testing::TestWithParam<ForceMethod> {};

TEST_P(ByMethod, AFloorAt60HzIsItsClosedFormAt1kHz) {
  const std::vector<Vec3> path_m = press_and_slide();
  device::ReplayDevice device(states_of(path_m), {});
  FloorEngine engine;
  const std::array tools = {LayerTool{&device, plain(GetParam())}};
  LockstepLayer lockstep(engine, tools);
  Expected expected(GetParam());
  double largest_N = 0.0;
  for (std::size_t tick = 0; tick < path_m.size(); ++tick) {
    const std::uint64_t steps = lockstep.step_count();
    lockstep.tick();
    const messages::ToolState& tool = lockstep.loop(0).tool_state();
    const double force_N = expected.force_N(path_m, tick, lockstep.step_count() != steps);
    EXPECT_NEAR(tool.force_world_N[2], force_N, 1e-9) << tick;
    EXPECT_NEAR(std::hypot(tool.force_world_N[0], tool.force_world_N[1]), 0.0, 1e-9) << tick;
    EXPECT_EQ(tool.faults, 0u) << tick;
    largest_N = std::max(largest_N, tool.force_world_N[2]);
  }
  EXPECT_GT(largest_N, 1.0);
  // Actio, reactio: what the engine got last pulls the floor down with what the hand felt.
  const messages::ToolState& told = engine.state(0);
  EXPECT_EQ(told.contact.surface, 0);
  const double on_floor_N = told.contact.stiffness_N_m * (told.contact.target_world_m[2] - told.touched_world_m[2]);
  EXPECT_NEAR(on_floor_N, -told.force_world_N[2], 1e-9);
}

std::string name_of(const ::testing::TestParamInfo<ForceMethod>& which) {
  constexpr std::array kNames = {"Proxy", "Penetration", "Plane"};
  return kNames[static_cast<std::size_t>(which.param)];
}

INSTANTIATE_TEST_SUITE_P(Methods, ByMethod,
                         ::testing::Values(ForceMethod::Proxy, ForceMethod::Penetration, ForceMethod::Plane), name_of);

/// The proxy leads the step that is played by a quarter: its floor comes 3/4 of a step late and evenly, although steps
/// are 16 or 17 ticks apart.
TEST(ForceLayer, AFloorThatRisesIsPlayedEvenlyThreeQuartersOfAStepLate) {
  constexpr double kSpeed_m_s = 5e-3;
  const Vec3 hand_m(0, 0, kRadius_m + 1e-3);
  device::ReplayDevice device(states_of(std::vector<Vec3>(600, hand_m)), {});
  FloorEngine engine;
  engine.speed_m_s = kSpeed_m_s;
  const std::array tools = {LayerTool{&device, plain(ForceMethod::Proxy)}};
  LockstepLayer lockstep(engine, tools);
  constexpr double kRounding_N = 1e-7;  // times are whole nanoseconds
  double force_N = 0.0;
  for (int tick = 0; tick < 550; ++tick) {
    const double height_m = kSpeed_m_s * std::max(0.0, lockstep.time_s() - 0.75 * engine.step_s());
    lockstep.tick();
    force_N = lockstep.loop(0).tool_state().force_world_N[2];
    EXPECT_NEAR(force_N, kStiffness_N_m * std::max(0.0, height_m - 1e-3), kRounding_N) << tick;
  }
  EXPECT_GT(force_N, 1.0);
}

/// C, k0 = 800 N/m: a hand that holds a body which leaves at 5 mm/s feels k0 times the way to its newest place.
TEST(ForceLayer, PullingIsASpringToTheNewestPlaceOfTheBody) {
  const Vec3 hand_m(0, 0, 0.02);
  device::ReplayDevice device(states_of(std::vector<Vec3>(600, hand_m), messages::kGrabBoneButton), {});
  FloorEngine engine;
  engine.speed_m_s = -5e-3;
  const std::array tools = {LayerTool{&device, plain(ForceMethod::Pulling)}};
  LockstepLayer lockstep(engine, tools);
  double closed_at_m = 0.0;
  for (int tick = 0; tick < 550; ++tick) {
    lockstep.tick();
    if (tick == 200) closed_at_m = engine.height_m();  // the model in use is that of the newest step
    const double force_N = tick < 200 ? 0.0 : kStiffness_N_m * (engine.height_m() - closed_at_m);
    EXPECT_NEAR(lockstep.loop(0).tool_state().force_world_N[2], force_N, 1e-9) << tick;
  }
  EXPECT_LT(lockstep.loop(0).tool_state().force_world_N[2], -1.0);
  const messages::ToolState& told = engine.state(0);
  EXPECT_EQ(told.grabbed_body, 0);
  EXPECT_EQ(told.body_stiffness_N_m, kStiffness_N_m);
  EXPECT_NEAR(told.body_target_world_m[2], closed_at_m, 1e-12);  // the hand has not moved
}

TEST(LockstepLayer, StepsOf60HzNeitherDriftNorBunch) {
  device::ReplayDevice device(states_of({Vec3(0, 0, 0.1)}), {});
  FloorEngine engine;
  const std::array tools = {LayerTool{&device, {}}};
  LockstepLayer lockstep(engine, tools);
  int since = 0;
  for (int tick = 0; tick < 10'000; ++tick, ++since) {
    const int before = engine.steps;
    lockstep.tick();
    if (engine.steps == before) continue;
    EXPECT_EQ(engine.steps, before + 1);
    EXPECT_TRUE(since == 16 || since == 17) << since;
    since = 0;
  }
  EXPECT_EQ(engine.steps, 599);  // the 600th is due at 10 s sharp, with the next tick
  lockstep.tick();
  EXPECT_EQ(engine.steps, 600);
}

/// A hand of 300 N/m that presses with 1 N and slides at 50 mm/s; the largest change of force from tick to tick once it
/// slides. Until then friction sticks, and its spring loads by 800 N/m * 50 um a tick: 40 mN.
double largest_step_N(ForceMethod method) {
  haptics::HapticSettings settings;
  settings.method = method;
  settings.contact.radius_m = kRadius_m;
  device::SimulatedDevice device("simulated", Vec3(-0.04, 0, 0.01));
  FloorEngine engine;
  const std::array tools = {LayerTool{&device, settings}};
  LockstepLayer lockstep(engine, tools);
  const double pressed_m = kRadius_m - 1.0 / kStiffness_N_m - 1.0 / device::HandProfile{}.stiffness_N_m;
  Vec3 last_N = Vec3::Zero();
  double largest_N = 0.0, sum_N = 0.0;
  for (int tick = 0; tick < 3600; ++tick) {
    const double x_m = -0.04 + 0.05 * 1e-3 * std::max(0, tick - 2000);
    const double z_m = 0.01 + (pressed_m - 0.01) * std::clamp(1e-3 * (tick - 1200) / 0.5, 0.0, 1.0);
    device.set_hand_target({{x_m, 0, z_m}, {tick > 2000 ? 0.05 : 0.0, 0, 0}, 0});
    lockstep.tick();
    const Vec3 force_N = to_vec3(lockstep.loop(0).tool_state().force_world_N);
    if (tick >= 2200) {
      largest_N = std::max(largest_N, (force_N - last_N).norm());
      sum_N += force_N.z() / 1400.0;
    }
    last_N = force_N;
  }
  EXPECT_NEAR(sum_N, 1.0, 0.1);
  return largest_N;
}

TEST(ForceLayer, TheProxysForceIsContinuousInASlide) {
  const double proxy_N = largest_step_N(ForceMethod::Proxy);
  std::printf("largest step of force in a slide at 50 mm/s: proxy %.1f, penetration %.1f, plane %.1f mN\n",
              1e3 * proxy_N, 1e3 * largest_step_N(ForceMethod::Penetration), 1e3 * largest_step_N(ForceMethod::Plane));
  EXPECT_LE(proxy_N, 0.030);
}

/// Two tools that press, for what concerns both.
class TwoTools : public ::testing::Test {
 protected:
  TwoTools() { run(700, -2e-3); }

  static haptics::HapticSettings settings() {
    haptics::HapticSettings settings;
    settings.gate.ramp_s = 0.1;
    return settings;
  }
  void run(int ticks, double height_m, std::uint32_t buttons_of_second = 0) {
    for (int i = 0; i < ticks; ++i, ++tick_) {
      const double z_m = tick_ < 200 ? 0.01 : height_m;
      first_.set_hand_target({{-0.02, 0, z_m}, {}, 0});
      second_.set_hand_target({{0.02, 0, z_m}, {}, buttons_of_second});
      lockstep_.tick();
    }
  }
  double force_N(int tool) { return to_vec3(lockstep_.loop(tool).tool_state().force_world_N).norm(); }

  device::SimulatedDevice first_{"first", Vec3(-0.02, 0, 0.01)}, second_{"second", Vec3(0.02, 0, 0.01)};
  FloorEngine engine_;
  LockstepLayer lockstep_{engine_, std::array{LayerTool{&first_, settings()}, LayerTool{&second_, settings()}}};
  int tick_ = 0;
};

TEST_F(TwoTools, FeelTheSameFloorEachForItself) {
  EXPECT_GT(force_N(0), 0.5);
  EXPECT_NEAR(force_N(0), force_N(1), 1e-9);
  EXPECT_LT(engine_.state(0).tool_position_world_m[0], 0.0);
  EXPECT_GT(engine_.state(1).tool_position_world_m[0], 0.0);
}

TEST_F(TwoTools, OneStopTakesTheForceFromBoth) {
  run(2, -2e-3, messages::kStopButton);  // on the second device: zero within two ticks
  EXPECT_EQ(force_N(0), 0.0);
  EXPECT_EQ(force_N(1), 0.0);
  run(300, 0.01);
  EXPECT_EQ(lockstep_.loop(0).gate_state(), haptics::GateState::Off);
  EXPECT_EQ(lockstep_.loop(1).gate_state(), haptics::GateState::Off);
  lockstep_.layer().stop_forces(false);
  run(1, 0.01);
  EXPECT_EQ(lockstep_.loop(0).gate_state(), haptics::GateState::Ramp);
  run(300, -2e-3);
  EXPECT_GT(force_N(0), 0.5);
  EXPECT_GT(force_N(1), 0.5);
  lockstep_.layer().stop_forces(true);
  run(1, -2e-3);
  EXPECT_EQ(force_N(0), 0.0);
  EXPECT_EQ(force_N(1), 0.0);
}

TEST_F(TwoTools, GiveTheSameBitsEveryTime) {
  const auto felt = [] {
    FloorEngine engine;
    device::SimulatedDevice first("first", Vec3(-0.02, 0, 0.01)), second("second", Vec3(0.02, 0, 0.01));
    LockstepLayer lockstep(engine, std::array{LayerTool{&first, settings()}, LayerTool{&second, settings()}});
    std::vector<double> forces_N;
    for (int tick = 0; tick < 500; ++tick) {
      first.set_hand_target({{-0.02 + 2e-5 * tick, 0, tick < 200 ? 0.01 : -1e-3}, {}, 0});
      second.set_hand_target({{0.02, 1e-5 * tick, tick < 200 ? 0.01 : -2e-3}, {}, 0});
      lockstep.tick();
      for (int tool = 0; tool < 2; ++tool) {
        for (const double f : lockstep.loop(tool).tool_state().force_world_N) forces_N.push_back(f);
      }
    }
    return forces_N;
  };
  EXPECT_EQ(felt(), felt());
}

}  // namespace
}  // namespace myotact::layer
