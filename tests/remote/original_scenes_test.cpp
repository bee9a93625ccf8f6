// The scenes of the older research system on the wall clock, hand and simulation at two ends of a connection: every
// force that the hand got is that of the model which it had, as old as that model was.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "device/simulated_device.h"
#include "remote/free_hand.h"
#include "remote/served_scene.h"
#include "scene/conductor.h"
#include "scene/recording.h"

namespace myotact::remote {
namespace {

using Tethers = std::map<std::uint64_t, messages::LocalTether>;  // by the sequence of their models

/// What a hand felt that was led to and fro once the gate was open.
std::vector<haptics::HapticTick> ticks_felt(FreeHand& hand, device::SimulatedDevice& device) {
  constexpr double kRamp_s = 1.5, kLed_s = 2.0;
  std::vector<haptics::HapticTick> ticks;
  const auto start = std::chrono::steady_clock::now();
  for (double time_s = 0.0; time_s < kRamp_s + kLed_s;) {
    time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double led_s = std::max(0.0, time_s - kRamp_s);
    const Vec3 place_m(0.03 * std::sin(3.0 * led_s), 0.015 * std::sin(4.0 * led_s), 0.01 * std::sin(2.0 * led_s));
    device.set_hand_target({to_array(place_m), {}, 0, {}});
    for (haptics::HapticTick tick; hand.loop().ticks().pop(tick);) {
      if (tick.gate == haptics::GateState::On) ticks.push_back(tick);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return ticks;
}

/// The models of a recorded run, simulated again.
Tethers tethers_of(const scene::Scene& scene, const scene::Recording& recording) {
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const scene::Conductor start(scene, simulation);
  messages::LocalModel model;
  Tethers tethers;
  std::size_t step = 0;
  for (const scene::ModelRecord& record : recording.tools.at(0).models) {
    for (; step < record.step; ++step) {
      scene::apply(recording.steps[step], simulation);
      simulation.step(recording.steps[step].tools);
    }
    simulation.write_local_model({}, model);
    tethers[record.sequence] = model.tether;
  }
  return tethers;
}

/// F = k (x + s v - hand), s the age of the model: at least 0, and 2 steps at most.
void expect_felt(const haptics::HapticTick& tick, const messages::LocalTether& tether) {
  const Vec3 x_m = to_vec3(tether.anchor_world_m), v_m_s = to_vec3(tether.anchor_velocity_world_m_s);
  const Vec3 hand_m = to_vec3(tick.tool.tool_position_world_m), force_N = to_vec3(tick.tool.force_world_N);
  const Vec3 moved_m = force_N / tether.stiffness_N_m + hand_m - x_m;
  const double age_s = v_m_s.norm() > 0.0 ? moved_m.dot(v_m_s) / v_m_s.squaredNorm() : 0.0;
  EXPECT_LE((force_N - tether.stiffness_N_m * (x_m + age_s * v_m_s - hand_m)).norm(), 1e-9);
  constexpr double kRounding_N = 1e-9;
  const double rounding_s = kRounding_N / (tether.stiffness_N_m * std::max(v_m_s.norm(), 1e-9));
  EXPECT_GE(age_s, -rounding_s);
  EXPECT_LE(age_s, 0.02 + rounding_s);
}

class OriginalScenes : public ::testing::TestWithParam<const char*> {};

TEST_P(OriginalScenes, AreFeltWithinTheAgeOfTheModel) {
  const auto path = std::filesystem::temp_directory_path() / (std::string("myotact_far_") + std::to_string(::getpid()));
  const scene::Scene scene = scene::load_scene(GetParam());
  std::vector<haptics::HapticTick> ticks;
  {
    simulation::Simulation simulation(scene.specimen, scene.settings);
    scene::RecordingWriter writer(path, "{}");
    ServedScene served(scene, simulation, {{"127.0.0.1", 0}, {}, 1}, &writer);
    served.start();
    net::ClientSettings settings;
    settings.server = {"127.0.0.1", served.server().port()};
    settings.hello.role = net::Role::Student;
    settings.hello.wants.hand = true;
    device::SimulatedDevice device("simulated", Vec3::Zero());
    FreeHand hand(settings, device, scene.tools[0], nullptr);
    hand.start();
    ticks = ticks_felt(hand, device);
    hand.stop();
    served.stop();
  }
  const scene::Recording recording = scene::read_recording(path);
  std::filesystem::remove(path);
  const Tethers tethers = tethers_of(scene, recording);
  ASSERT_GT(ticks.size(), 500u);
  double largest_N = 0.0;
  for (const haptics::HapticTick& tick : ticks) {
    ASSERT_TRUE(tethers.contains(tick.model_sequence));
    expect_felt(tick, tethers.at(tick.model_sequence));
    largest_N = std::max(largest_N, to_vec3(tick.tool.force_world_N).norm());
    if (::testing::Test::HasFailure()) break;
  }
  EXPECT_GT(largest_N, 0.3);
}

INSTANTIATE_TEST_SUITE_P(OverTheNetwork, OriginalScenes, ::testing::Values("spring", "particle"));

}  // namespace
}  // namespace myotact::remote
