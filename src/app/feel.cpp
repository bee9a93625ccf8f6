#include <algorithm>
#include <chrono>
#include <iostream>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "app/equipment.h"
#include "app/guarded_motors.h"
#include "app/interruption.h"
#include "app/network_options.h"
#include "app/options.h"
#include "core/error.h"
#include "core/file.h"
#include "device/drivers/driver_table.h"
#include "haptics/faults.h"
#include "net/scene_inquiry.h"
#include "remote/free_hand.h"
#include "remote/lockstep_hand.h"
#include "remote/scene_message.h"
#include "scene/extremes.h"
#include "scene/samples.h"

namespace myotact::app {

namespace {

constexpr double kForever_s = 1e12;

/// What a hand did far from the simulation: the columns of samples.csv that are its own.
struct HandRun {
  HandRun(const scene::ToolSettings& tool, int every) : samples(anatomy::Specimen{}, {tool.hand}, every) {}

  void add(double time_s, const haptics::HapticTick& tick, const simulation::Simulation& limb) {
    const scene::ToolSample sample{tick.tool, tick.line_tension_N};
    samples.add(time_s, {&sample, 1}, limb);
    extremes.add_tick(0, tick);
    ++ticks;
  }

  scene::SampleTable samples;
  scene::Extremes extremes;
  std::uint64_t ticks = 0;
  nlohmann::json link;  // of a hand on the wall clock
};

HandRun feel_in_lockstep(const Options& options, const scene::Scene& scene, remote::ScriptedDevice& device) {
  HandRun run(scene.tools[0], options.every);
  remote::LockstepHand hand(server_of(options), own_token(options), scene.tools[0], device);
  const double end_s = options.seconds.value_or(device.script_end_s());
  while (hand.time_s() < end_s - 0.5 * scene.settings.dt_s && interruption() == 0) {
    hand.step([&](double time_s, const haptics::HapticTick& tick) { run.add(time_s, tick, device.limb()); });
  }
  return run;
}

nlohmann::json link_json(remote::FreeHand& hand) {
  const net::LinkStatus link = hand.client().status();
  return {{"round_trip_ms", 1e3 * link.round_trip_s},
          {"connections", link.connections},
          {"ticks", hand.thread().tick_count()},
          {"missed_ticks", hand.thread().missed_count()}};
}

HandRun feel_free(const Options& options, const scene::Scene& scene, remote::ScriptedDevice& scripted,
                  GuardedMotors& guarded, const Equipment& equipment) {
  HandRun run(scene.tools[0], options.every);
  const std::unique_ptr<device::PlacedDevice> on_table =
      equipment.empty() ? nullptr : equipment.place(scene.tools[0].device, scene, 0);
  if (!on_table) scripted.device().drive(guarded.motors[0]);
  device::Device& device = on_table ? static_cast<device::Device&>(*on_table) : scripted.device();
  net::ClientSettings settings;
  settings.server = server_of(options);
  settings.hello.role = net::Role::Student;
  settings.hello.wants.hand = true;
  settings.hello.token = own_token(options);
  settings.hello.name = "feel";
  remote::FreeHand hand(settings, device, scene.tools[0], on_table ? nullptr : &guarded.watchdog,
                        on_table ? equipment.device(scene.tools[0].device).servo_clock() : nullptr);
  if (!hand.loop().notice().empty()) spdlog::warn("{}", hand.loop().notice());
  hand.start();
  if (!hand.thread().refused().empty()) spdlog::warn("{}", hand.thread().refused());
  const auto start = std::chrono::steady_clock::now();
  const double end_s = options.seconds.value_or(on_table ? kForever_s : scripted.script_end_s());
  HintLog hints(equipment);
  for (double time_s = 0.0; time_s < end_s && interruption() == 0;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    hints.look();
    time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    scripted.begin_step(time_s);
    scripted.move_to(time_s);
    for (haptics::HapticTick tick; hand.loop().ticks().pop(tick);) {
      run.add(1e-3 * static_cast<double>(run.ticks), tick, scripted.limb());
    }
    if (hand.client().status().is_final) throw Error(ExitStatus::Unavailable, hand.client().status().why);
  }
  hand.stop();
  run.link = link_json(hand);
  return run;
}

}  // namespace

int feel(const Options& options) {
  std::optional<GuardedMotors> guarded;
  guarded.emplace();  // first: the watchdog is forked off before there are threads
  const net::SceneAnswer answer = net::ask_scene(server_of(options), own_token(options));
  scene::Scene scene = remote::scene_of_message(answer.scene_json);
  if (options.devices.size() > 1) {
    throw Error(ExitStatus::Usage, "--device: this is one hand; start it once more for another device");
  }
  take_devices(options, scene);
  const Equipment equipment(options);
  const auto on_device = [](const scene::ToolSettings& tool) { return device::is_on_the_table(tool.device); };
  // The tool of that hand becomes the one that is felt here.
  if (const auto tool = std::find_if(scene.tools.begin(), scene.tools.end(), on_device); tool != scene.tools.end()) {
    std::iter_swap(scene.tools.begin(), tool);
  }
  if (!equipment.empty() && answer.welcome.lockstep) {
    throw Error(ExitStatus::Usage, "--device: the server runs in lockstep, and a hand moves on the wall clock");
  }
  make_writable_folder(options.out);
  watch_for_interruption();
  scene::Scene scripted = scene;
  if (!equipment.empty()) scripted.tools[0].device = "simulated";  // its hand is not heeded
  remote::ScriptedDevice device(scripted, 0);
  const HandRun run = answer.welcome.lockstep ? feel_in_lockstep(options, scene, device)
                                              : feel_free(options, scene, device, *guarded, equipment);
  const scene::ToolExtremes& reached = run.extremes.tools[0];
  nlohmann::json report = {{"scene", scene.name},
                           {"largest_force_N", reached.force_N},
                           {"contact_s", reached.contact_s},
                           {"faults", haptics::describe_faults(static_cast<std::uint32_t>(reached.faults))}};
  if (!run.link.is_null()) report["link"] = run.link;
  write_file(options.out / "samples.csv", run.samples.csv());
  write_file(options.out / "summary.json", report.dump(2) + "\n");
  std::cout << report.dump(2) << std::endl;
  return interruption();
}

}  // namespace myotact::app
