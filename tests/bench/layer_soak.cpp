// The force layer for a long time on the wall clock: layer_soak [floor|myotact|bullet] [SECONDS]. Two hands slide in
// circles on a plane at 50 mm/s and 1 N, one by the proxy, one by reported depths; everything that crosses between the
// threads is looked at for torn reads. Exit status 1: there was one.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "anatomy/specimen.h"
#include "core/data_folder.h"
#include "device/simulated_device.h"
#include "layer/bullet_engine.h"
#include "layer/floor_engine.h"
#include "layer/layer_threads.h"
#include "layer/simulation_engine.h"
#include "layer/tearing_watch.h"

namespace myotact::layer {
namespace {

constexpr double kCircle_m = 0.015;
constexpr double kSpeed_m_s = 0.05;
constexpr double kPress_N = 1.0;
constexpr double kStep_s = 1.0 / 60.0;

std::unique_ptr<Engine> make_engine(const std::string& name, const anatomy::Specimen& plane) {
  if (name == "bullet") {
    return make_bullet_engine(plane, {.step_s = kStep_s, .tools = {{.radius_m = kRadius_m}, {.radius_m = kRadius_m}}});
  }
  if (name == "floor") return std::make_unique<FloorEngine>();
  simulation::SimulationSettings settings;
  settings.dt_s = kStep_s;
  settings.workers = 1;
  return std::make_unique<SimulationEngine>(plane, settings, std::vector{kRadius_m, kRadius_m});
}

haptics::HapticSettings settings_of(haptics::ForceMethod method) {
  haptics::HapticSettings settings;
  settings.method = method;
  settings.contact.radius_m = kRadius_m;
  return settings;
}

/// Where a hand wants its stylus: 2 s above the plane while the gate opens, then down and round and round.
device::HandTarget target(double x_m, double t_s, double stiffness_N_m) {
  const double depth_m = kPress_N / haptics::ContactSettings{}.stiffness_N_m + kPress_N / stiffness_N_m;
  const double down = std::clamp((t_s - 2.0) / 0.5, 0.0, 1.0);
  const double angle_rad = kSpeed_m_s / kCircle_m * std::max(0.0, t_s - 3.0);
  const double speed_m_s = t_s > 3.0 ? kSpeed_m_s : 0.0;
  return {{x_m + kCircle_m * std::cos(angle_rad), kCircle_m * std::sin(angle_rad),
           0.01 + down * (kRadius_m - depth_m - 0.01)},
          {-speed_m_s * std::sin(angle_rad), speed_m_s * std::cos(angle_rad), 0.0},
          0};
}

void report(const std::string& engine, LayerThreads& threads, const std::array<WatchedDevice, 2>& devices,
            const WatchedEngine& watched) {
  const auto us = [](std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); };
  const auto period = threads.devices().periods().summary();
  const auto step = threads.steps().summary();
  const double ticks = static_cast<double>(threads.devices().tick_count());
  const double missed = static_cast<double>(threads.devices().missed_count());
  std::printf("engine %s: %.0f ticks, %.0f missed (%.4f %%)\n", engine.c_str(), ticks, missed,
              100.0 * missed / (ticks + missed));
  std::printf("  period p50 %.0f, p99 %.0f, p99.9 %.0f, max %.0f us\n", us(period.p50_ns), us(period.p99_ns),
              us(period.p999_ns), us(period.max_ns));
  std::printf("  step of the engine p50 %.0f, p99 %.0f, max %.0f us\n", us(step.p50_ns), us(step.p99_ns),
              us(step.max_ns));
  for (std::size_t tool = 0; tool < devices.size(); ++tool) {
    const auto tick = threads.devices().ticks(tool).summary();
    const TearingWatch& watch = watched.watches[tool];
    std::printf(
        "  %s: tick p50 %.1f, p99 %.1f us; largest step of force %.1f mN, %lu over 30 mN; %lu reads of models "
        "and %lu of states looked at, %lu torn\n",
        tool == 0 ? "proxy" : "penetration", us(tick.p50_ns), us(tick.p99_ns), 1e3 * devices[tool].largest_step_N(),
        devices[tool].large_steps(), watch.models(), watch.states(), watch.torn());
  }
}

int soak(const std::string& name, double seconds) {
  const anatomy::Specimen plane = anatomy::load_specimen(data_folder() / "meshes" / "plane");
  const std::unique_ptr<Engine> engine = make_engine(name, plane);
  std::array<device::SimulatedDevice, 2> hands{device::SimulatedDevice("left", Vec3(-0.03 + kCircle_m, 0, 0.01)),
                                               device::SimulatedDevice("right", Vec3(0.03 + kCircle_m, 0, 0.01))};
  std::array<WatchedDevice, 2> devices{WatchedDevice(hands[0]), WatchedDevice(hands[1])};
  WatchedEngine watched(*engine);
  const std::array tools{LayerTool{&devices[0], settings_of(haptics::ForceMethod::Proxy)},
                         LayerTool{&devices[1], settings_of(haptics::ForceMethod::Penetration)}};
  ForceLayer layer(watched, tools);
  for (std::size_t i = 0; i < 2; ++i) {
    watched.loops[i] = &layer.loop(static_cast<int>(i));
    devices[i].watch(*watched.loops[i], watched.watches[i]);
  }
  LayerThreads threads(layer);
  threads.start();
  const auto begin = std::chrono::steady_clock::now();
  bool slides = false;
  for (double t_s = 0.0; t_s < seconds;) {
    for (std::size_t i = 0; i < 2; ++i) {
      hands[i].set_hand_target(target(i == 0 ? -0.03 : 0.03, t_s, device::HandProfile{}.stiffness_N_m));
    }
    if (!slides && t_s > 3.5) {  // touching down and the first slip are no slide
      for (WatchedDevice& device : devices) device.begin_again();
      slides = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(4));
    t_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  threads.stop();
  report(name, threads, devices, watched);
  return watched.watches[0].torn() + watched.watches[1].torn() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace myotact::layer

int main(int argc, char** argv) {
  const std::string engine = argc > 1 ? argv[1] : "floor";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 60.0;
  try {
    return myotact::layer::soak(engine, seconds);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "layer_soak: %s\n", failure.what());
    return 2;
  }
}
