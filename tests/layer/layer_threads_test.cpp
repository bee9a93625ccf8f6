#include "layer/layer_threads.h"

#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "core/log.h"
#include "device/simulated_device.h"
#include "floor_engine.h"
#include "realtime/periodic_loop.h"
#include "tearing_watch.h"

namespace myotact::layer {
namespace {

using std::chrono::milliseconds;

/// As in the program, the log is there before there are threads: the library's own guard of its first use is not seen
/// by the thread sanitizer.
const bool kHasLog = (start_log("warn"), true);

haptics::HapticSettings quick_to_ramp() {
  haptics::HapticSettings settings;
  settings.contact.radius_m = kRadius_m;
  settings.gate.ramp_s = 0.1;
  return settings;
}

/// Two hands that touch a floor, free on the wall clock.
struct FreeRun {
  FreeRun() {
    for (std::size_t i = 0; i < 2; ++i) {
      watched.loops[i] = &layer.loop(static_cast<int>(i));
      devices[i].watch(*watched.loops[i], watched.watches[i]);
    }
  }
  void press(double height_m) {
    hands[0].set_hand_target({{-0.02, 0, height_m}, {}, 0});
    hands[1].set_hand_target({{0.02, 0, height_m}, {}, 0});
  }
  void wait(milliseconds time) { std::this_thread::sleep_for(time); }

  std::array<device::SimulatedDevice, 2> hands{device::SimulatedDevice{"first", Vec3(-0.02, 0, 0.01)},
                                               device::SimulatedDevice{"second", Vec3(0.02, 0, 0.01)}};
  std::array<WatchedDevice, 2> devices{WatchedDevice{hands[0]}, WatchedDevice{hands[1]}};
  FloorEngine engine;
  WatchedEngine watched{engine};
  ForceLayer layer{watched,
                   std::array{LayerTool{&devices[0], quick_to_ramp()}, LayerTool{&devices[1], quick_to_ramp()}}};
  LayerThreads threads{layer};
};

TEST(LayerThreads, RunFreeForThreeSecondsWithoutATornRead) {
  ASSERT_TRUE(kHasLog);
  FreeRun run;
  run.threads.start();
  run.wait(milliseconds(500));
  run.press(-2e-3);
  run.wait(milliseconds(2500));
  run.threads.stop();
  std::uint64_t models = 0, states = 0, torn = 0;
  for (const TearingWatch& watch : run.watched.watches) {
    models += watch.models();
    states += watch.states();
    torn += watch.torn();
  }
  const auto period = run.threads.devices().periods().summary();
  std::printf(
      "%d steps; %lu ticks, %lu missed; period p50 %.0f, p99.9 %.0f us; step p99 %.0f us; %lu models and %lu "
      "states looked at, %lu torn\n",
      run.engine.steps, run.threads.devices().tick_count(), run.threads.devices().missed_count(),
      1e-3 * static_cast<double>(period.p50_ns), 1e-3 * static_cast<double>(period.p999_ns),
      1e-3 * static_cast<double>(run.threads.steps().summary().p99_ns), models, states, torn);
  EXPECT_EQ(torn, 0u);
  EXPECT_GT(models, 1000u);
  EXPECT_GT(states, 50u);
  EXPECT_GT(run.engine.steps, 60);
  EXPECT_GT(run.devices[0].largest_step_N(), 0.0);  // something was felt
  for (int tool = 0; tool < 2; ++tool) {
    EXPECT_EQ(to_vec3(run.layer.loop(tool).tool_state().force_world_N).norm(), 0.0);
    EXPECT_EQ(run.layer.loop(tool).gate_state(), haptics::GateState::Off);
  }
}

TEST(LayerThreads, TheirWatchFindsATornRead) {
  FloorEngine engine;
  engine.move_tool(0, {});
  messages::LocalModel model, other;
  engine.write_surface(0, model);
  TearingWatch::stamp(model, 1);
  TearingWatch watch;
  watch.look_at(model);
  EXPECT_EQ(watch.torn(), 0u);
  engine.speed_m_s = 1e-6;
  engine.advance();
  engine.write_surface(0, other);
  model.current_world_m[50] = other.current_world_m[50];  // one place of the next step among those of this one
  watch.look_at(model);
  EXPECT_EQ(watch.torn(), 1u);
}

/// An engine that hangs for a while, and one that dies.
class HangingEngine : public FloorEngine {
 public:
  void advance() override {
    FloorEngine::advance();
    if (dies) throw std::runtime_error("died");
    while (hangs) std::this_thread::sleep_for(milliseconds(1));
  }
  std::atomic<bool> hangs{false}, dies{false};
};

TEST(LayerThreads, NameAnEngineThatHangsAndGoOnWhenItDoes) {
  HangingEngine engine;
  device::SimulatedDevice device("simulated", Vec3(0, 0, 0.01));
  ForceLayer layer(engine, std::array{LayerTool{&device, quick_to_ramp()}});
  LayerThreads threads(layer);
  threads.start();
  std::this_thread::sleep_for(milliseconds(300));
  engine.hangs = true;
  std::this_thread::sleep_for(milliseconds(600));
  EXPECT_TRUE(layer.silent_since_ns(realtime::steady_now_ns()));
  EXPECT_EQ(layer.check().count(ReportDefect::Silent), 0u);  // it has not come back yet
  engine.hangs = false;
  const auto came_back = [&] { return layer.check().count(ReportDefect::Silent) >= 1; };
  for (int i = 0; i < 100 && !came_back(); ++i) std::this_thread::sleep_for(milliseconds(20));
  EXPECT_TRUE(came_back());
  threads.stop();
}

TEST(LayerThreads, TellWhatEndedTheEngine) {
  HangingEngine engine;
  device::SimulatedDevice device("simulated", Vec3(0, 0, 0.01));
  ForceLayer layer(engine, std::array{LayerTool{&device, quick_to_ramp()}});
  LayerThreads threads(layer);
  threads.start();
  engine.dies = true;
  std::this_thread::sleep_for(milliseconds(200));
  EXPECT_THROW(threads.stop(), std::runtime_error);
  EXPECT_EQ(layer.loop(0).gate_state(), haptics::GateState::Off);
}

}  // namespace
}  // namespace myotact::layer
