#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include <spdlog/spdlog.h>

#include "app/guarded_motors.h"
#include "app/interruption.h"
#include "app/joint_watch.h"
#include "app/options.h"
#include "app/picture.h"
#include "core/file.h"
#include "device/mouse_device.h"
#include "device/simulated_device.h"
#include "haptics/stiffness_bound.h"
#include "scene/free_session.h"
#include "view/window.h"

namespace myotact::app {

namespace {

constexpr double kForever_s = 1e12;

/// The picture gives way: it is drawn at most 60 times a second and takes at most half of the time, or a software
/// renderer would starve the simulation.
void leave_time_to_the_simulation(std::chrono::steady_clock::duration drawing) {
  constexpr std::chrono::milliseconds kPicture(16);
  std::this_thread::sleep_for(std::max<std::chrono::steady_clock::duration>(kPicture - drawing, drawing));
}

/// The devices of a scene's tools, and which of them the script moves.
struct Hands {
  Hands(const scene::Scene& scene, std::size_t led, GuardedMotors* guarded);

  std::size_t led;            // the tool that the mouse moves; none: as many as there are tools
  device::MouseDevice mouse;  // of that one
  std::vector<std::unique_ptr<device::SimulatedDevice>> simulated;
  std::vector<scene::ToolDevice> devices;  // one a tool
};

Hands::Hands(const scene::Scene& scene, std::size_t led_tool, GuardedMotors* guarded)
    : led(led_tool), mouse(scene::start_of_hand(scene, led_tool < scene.tools.size() ? led_tool : 0)) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (t == led) {
      devices.push_back({&mouse, nullptr});
      continue;
    }
    simulated.push_back(std::make_unique<device::SimulatedDevice>("simulated", scene::start_of_hand(scene, t)));
    if (guarded != nullptr) simulated.back()->drive(guarded->motors[t]);
    devices.push_back({simulated.back().get(), simulated.back().get()});
  }
}

/// The tool that the mouse moves. Without devices named the person leads the right hand, or the only one.
std::size_t led_tool(const Options& options, const scene::Scene& scene) {
  for (std::size_t t = 0; t < options.devices.size(); ++t) {
    if (options.devices[t] == "mouse") return t;
  }
  if (!options.devices.empty()) return scene.tools.size();
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (scene.tools[t].hand == "right") return t;
  }
  return 0;
}

/// Where a person leads, the script does no more than move the other hand.
void leave_the_lead(std::size_t led, scene::Scene& scene) {
  if (led >= scene.tools.size()) return;
  std::erase_if(scene.script, [led](const scene::ScriptAction& action) {
    return !scene::moves_hand(action.deed) || action.tool == led;
  });
}

std::vector<device::DeviceProfile> profiles_of(const Hands& hands) {
  std::vector<device::DeviceProfile> profiles;
  for (const scene::ToolDevice& tool : hands.devices) profiles.push_back(tool.device->profile());
  return profiles;
}

std::string device_notes(const scene::Scene& scene, const Hands& hands) {
  std::string notes;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const std::string note =
        haptics::stiffness_notice(hands.devices[t].device->profile(), scene.tools[t].stiffness_N_m);
    if (!note.empty()) notes += note + "\n";
  }
  return notes;
}

view::SceneState start_of(const scene::Scene& scene) {
  view::SceneState start;
  start.gravity = scene.settings.gravity_m_s2.norm() > 0.0;
  if (scene.co_contraction) {
    start.common = scene.co_contraction->common;
    start.difference = scene.co_contraction->difference;
    start.hold_posture = scene.co_contraction->hold_posture;
  }
  return start;
}

view::WindowSettings window_settings(const scene::Scene& scene, const Hands& hands) {
  view::WindowSettings settings;
  settings.facts.name = scene.name;
  settings.facts.title = "Myotact: " + scene.title;
  settings.facts.note = device_notes(scene, hands) + scene.note;
  settings.facts.device_peaks_N.clear();
  for (const scene::ToolDevice& tool : hands.devices) {
    settings.facts.device_peaks_N.push_back(tool.device->profile().peak_force_N);
  }
  settings.facts.joint = watched_joint(scene);
  settings.hand_start_world_m = to_array(scene::start_of_hand(scene, hands.led < scene.tools.size() ? hands.led : 0));
  settings.start = start_of(scene);
  return settings;
}

/// `driven`: the person took over from the script before; where undo goes back to the script's, the levels that the
/// scene started with stand for it.
scene::Requests requests_of(const view::ViewControls& controls, bool driven) {
  const view::SceneState& state = controls.scene;
  scene::Requests requests;
  requests.flexors = state.flexors;
  requests.extensors = state.extensors;
  requests.common = state.common;
  requests.difference = state.difference;
  requests.levels_changed = state.drive == view::Drive::Levels;
  requests.balance_changed = state.drive == view::Drive::Balance || (state.drive == view::Drive::Script && driven);
  requests.hold_posture = state.hold_posture;
  requests.gravity = state.gravity;
  requests.paused = controls.paused;
  requests.stops = controls.stops;
  requests.arms = controls.arms;
  requests.steps = controls.steps;
  requests.resets = controls.resets;
  requests.shoves = controls.shoves;
  return requests;
}

/// A file that is whole whenever it is read; unlike write_file() it does not wait for the disk.
void replace_file(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path next = path.string() + ".next";
  std::ofstream(next, std::ios::binary) << text;
  std::filesystem::rename(next, path);
}

/// Tells what the window shows, a few times a second, where a file was named for it.
class WindowReport {
 public:
  explicit WindowReport(std::optional<std::filesystem::path> path) : path_(std::move(path)) {}

  void write(view::Window& window, const messages::SceneFrame& frame) {
    if (!path_ || std::chrono::steady_clock::now() < next_) return;
    constexpr std::chrono::milliseconds kPeriod(100);
    next_ = std::chrono::steady_clock::now() + kPeriod;
    replace_file(*path_, window.describe(frame));
  }

 private:
  std::optional<std::filesystem::path> path_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace

int view(const Options& options) {
  scene::Scene scene = scene_of(options);
  const std::size_t led = led_tool(options, scene);
  leave_the_lead(led, scene);
  std::optional<GuardedMotors> guarded;
  // First: the watchdog is forked off before there are threads.
  if (scene.tools.size() > 1 || led >= scene.tools.size()) guarded.emplace();
  Hands hands(scene, led, guarded ? &*guarded : nullptr);
  if (options.seconds) make_writable_folder(options.out);
  // First: without a display nothing is built.
  view::Window window(scene.specimen, window_settings(scene, hands));
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const auto recorder = open_recorder(options, scene, profiles_of(hands));
  scene::FreeSession session(scene, simulation, hands.devices, recorder.get(), guarded ? &guarded->watchdog : nullptr);
  if (!session.notice().empty()) spdlog::warn("{}", session.notice());
  watch_for_interruption();
  session.start();
  messages::SceneFrame frame;
  JointWatch watch(scene);
  WindowReport report(options.report_state);
  double common = scene.co_contraction ? scene.co_contraction->common : 0.0;
  bool driven = false;
  const double end_s = options.seconds.value_or(kForever_s);
  while (!window.should_close() && session.running() && interruption() == 0) {
    session.fetch_frame(frame);
    const bool last = frame.time_s >= end_s;
    if (last) window.save_next_picture(options.out / "window.png");
    const auto drawing_since = std::chrono::steady_clock::now();
    window.set_readings(watch.read(frame, common, session));
    const view::ViewControls& controls = window.draw(frame);
    report.write(window, frame);
    common = controls.scene.common;
    driven = driven || controls.scene.drive != view::Drive::Script;
    leave_time_to_the_simulation(std::chrono::steady_clock::now() - drawing_since);
    session.request(requests_of(controls, driven));
    hands.mouse.set_pointer(to_vec3(controls.hand_world_m), controls.hand_buttons);
    if (last) break;
  }
  if (const scene::FreeTiming timing = session.stop(); !timing.refused.empty()) spdlog::warn("{}", timing.refused);
  if (recorder) recorder->close();
  return interruption();
}

}  // namespace myotact::app
