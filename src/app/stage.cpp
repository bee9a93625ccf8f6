#include "app/stage.h"

#include <algorithm>

#include <spdlog/spdlog.h>

#include "app/scene_facts.h"
#include "device/profile_file.h"
#include "haptics/stiffness_bound.h"

namespace myotact::app {

namespace {

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
scene::Scene led_scene(const Options& options) {
  scene::Scene scene = scene_of(options);
  const std::size_t led = led_tool(options, scene);
  if (led >= scene.tools.size()) return scene;
  std::erase_if(scene.script, [led](const scene::ScriptAction& action) {
    return !scene::moves_hand(action.deed) || action.tool == led;
  });
  return scene;
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

Vec3 start_of_led_hand(const scene::Scene& scene, std::size_t led) {
  return scene::start_of_hand(scene, led < scene.tools.size() ? led : 0);
}

}  // namespace

Hands::Hands(const Options& options, const scene::Scene& scene, GuardedMotors& guarded)
    : led(led_tool(options, scene)), mouse(start_of_led_hand(scene, led)) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (t == led) {
      devices.push_back({&mouse, nullptr});
      continue;
    }
    const std::string& name = scene.tools[t].device;
    simulated.push_back(std::make_unique<device::SimulatedDevice>(name, scene::start_of_hand(scene, t),
                                                                  device::simulated_profile(name)));
    simulated.back()->drive(guarded.motors[t]);
    devices.push_back({simulated.back().get(), simulated.back().get()});
  }
}

Stage::Stage(const Options& options, GuardedMotors& guarded)
    : scene_(led_scene(options)),
      hands_(options, scene_, guarded),
      simulation_(scene_.specimen, scene_.settings),
      recorder_(open_recorder(options, scene_, profiles_of(hands_))),
      session_(scene_, simulation_, hands_.devices, recorder_.get(),
               hands_.simulated.empty() ? nullptr : &guarded.watchdog),
      watch_(scene_) {
  if (!session_.notice().empty()) spdlog::warn("{}", session_.notice());
}

Stage::~Stage() = default;

void Stage::move_hand(const view::ViewControls& controls) {
  hands_.mouse.set_pointer(to_vec3(controls.hand_world_m), controls.hand_buttons);
}

view::WindowSettings Stage::window_settings(const Options& options) const {
  view::WindowSettings settings;
  settings.facts = facts_of(scene_);
  settings.facts.file = options.scene;
  const Overrides overrides = overrides_of(options);
  if (const auto tissue = overrides.find("tissue.default"); tissue != overrides.end()) {
    settings.facts.tissue = tissue->second;
  }
  settings.facts.note = device_notes(scene_, hands_) + scene_.note;
  settings.facts.device_peaks_N.clear();
  for (const scene::ToolDevice& tool : hands_.devices) {
    settings.facts.device_peaks_N.push_back(tool.device->profile().peak_force_N);
  }
  settings.hand_start_world_m = to_array(start_of_led_hand(scene_, hands_.led));
  settings.start = start_of(scene_);
  return settings;
}

}  // namespace myotact::app
