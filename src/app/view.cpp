#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include <spdlog/spdlog.h>

#include "app/guarded_motor.h"
#include "app/interruption.h"
#include "app/joint_watch.h"
#include "app/options.h"
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

int watched_joint(const scene::Scene& scene) {
  return scene.co_contraction ? scene.co_contraction->joint : 0;
}

view::WindowSettings window_settings(const scene::Scene& scene, const device::Device& device, const Vec3& hand_m) {
  view::WindowSettings settings;
  settings.title = "Myotact: " + scene.title;
  const std::string notice = haptics::stiffness_notice(device.profile(), scene.tools.front().stiffness_N_m);
  settings.note = notice.empty() ? scene.note : notice + "\n" + scene.note;
  settings.device_peak_N = device.profile().peak_force_N;
  settings.joint = watched_joint(scene);
  settings.hand_start_world_m = to_array(hand_m);
  settings.start.gravity = scene.settings.gravity_m_s2.norm() > 0.0;
  if (scene.co_contraction) {
    settings.start.common = scene.co_contraction->common;
    settings.start.difference = scene.co_contraction->difference;
    settings.start.hold_posture = scene.co_contraction->hold_posture;
  }
  return settings;
}

scene::Requests requests_of(const view::ViewControls& controls) {
  scene::Requests requests;
  requests.flexors = controls.flexors;
  requests.extensors = controls.extensors;
  requests.common = controls.common;
  requests.difference = controls.difference;
  requests.levels_changed = controls.levels_changed;
  requests.balance_changed = controls.balance_changed;
  requests.hold_posture = controls.hold_posture;
  requests.gravity = controls.gravity;
  requests.paused = controls.paused;
  requests.stops = controls.stops;
  requests.arms = controls.arms;
  requests.steps = controls.steps;
  requests.resets = controls.resets;
  requests.shoves = controls.shoves;
  return requests;
}

}  // namespace

int view(const Options& options) {
  scene::Scene scene = scene_of(options);
  // Without a device named the mouse is the hand, and the script's hand stays away: the person leads.
  const bool scripted = !options.devices.empty() && options.devices.front() == "simulated";
  if (!scripted) scene.script.clear();
  std::optional<GuardedMotor> guarded;
  if (scripted) guarded.emplace();  // first: the watchdog is forked off before there are threads
  const Vec3 hand_m = scene::start_of_hand(scene.specimen);
  device::MouseDevice mouse(hand_m);
  device::SimulatedDevice simulated("simulated", hand_m);
  if (guarded) simulated.drive(guarded->motor);
  if (options.seconds) make_writable_folder(options.out);
  device::Device& device = scripted ? static_cast<device::Device&>(simulated) : mouse;
  // First: without a display nothing is built.
  view::Window window(scene.specimen, window_settings(scene, device, hand_m));
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const auto recorder = open_recorder(options, scene, device.profile());
  scene::FreeSession session(scene, simulation, device, scripted ? &simulated : nullptr, recorder.get(),
                             guarded ? &guarded->watchdog : nullptr);
  if (!session.notice().empty()) spdlog::warn("{}", session.notice());
  watch_for_interruption();
  session.start();
  messages::SceneFrame frame;
  JointWatch watch(scene);
  double common = scene.co_contraction ? scene.co_contraction->common : 0.0;
  const double end_s = options.seconds.value_or(kForever_s);
  while (!window.should_close() && session.running() && interruption() == 0) {
    session.fetch_frame(frame);
    const bool last = frame.time_s >= end_s;
    if (last) window.save_next_picture(options.out / "window.png");
    const auto drawing_since = std::chrono::steady_clock::now();
    window.set_readings(watch.read(frame, common, session));
    const view::ViewControls& controls = window.draw(frame);
    common = controls.common;
    leave_time_to_the_simulation(std::chrono::steady_clock::now() - drawing_since);
    session.request(requests_of(controls));
    mouse.set_pointer(to_vec3(controls.hand_world_m), controls.hand_buttons);
    if (last) break;
  }
  if (const scene::FreeTiming timing = session.stop(); !timing.refused.empty()) spdlog::warn("{}", timing.refused);
  if (recorder) recorder->close();
  return interruption();
}

}  // namespace myotact::app
