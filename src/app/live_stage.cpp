#include "app/live_stage.h"

#include <spdlog/spdlog.h>

#include "app/scene_facts.h"
#include "haptics/gate/stiffness_bound.h"

namespace myotact::app {

namespace {

/// The tool that the mouse moves. Without devices named the person leads the right hand, or the only one.
std::size_t led_tool(const Options& options, const scene::Scene& scene) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (scene.tools[t].device == "mouse") return t;
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
  bool a_person_leads = false;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) a_person_leads = a_person_leads || is_persons(scene, t, led);
  if (!a_person_leads) return scene;
  std::erase_if(scene.script, [](const auto& action) { return !scene::moves_hand(action.what); });
  leave_hands_to_people(scene, led);
  return scene;
}

std::string device_notes(const scene::Scene& scene, const Hands& hands) {
  std::string notes;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const std::string note =
        haptics::stiffness_notice(hands.devices()[t].device->profile(), scene.tools[t].stiffness_N_m);
    if (!note.empty()) notes += note + "\n";
  }
  return notes;
}

Vec3 start_of_led_hand(const scene::Scene& scene, std::size_t led) {
  return scene::start_of_hand(scene, led < scene.tools.size() ? led : 0);
}

}  // namespace

LiveStage::LiveStage(const Options& options, GuardedMotors& guarded, const Equipment& equipment)
    : scene_(led_scene(options)),
      hands_(scene_, led_tool(options, scene_), guarded, equipment),
      simulation_(scene_.specimen, scene_.settings),
      recorder_(open_recorder(options, scene_, hands_.profiles())),
      session_(scene_, simulation_, hands_.devices(), recorder_.get(), hands_.ticking()),
      watch_(scene_) {
  if (!session_.notice().empty()) spdlog::warn("{}", session_.notice());
}

LiveStage::~LiveStage() = default;

void LiveStage::lead(const view::ViewControls& controls) {
  hands_.ask_clutch(controls.clutch);
  hands_.follow_view(controls.view_axes_world);
  hands_.mouse().set_pointer(to_vec3(controls.hand_world_m), controls.hand_buttons);
}

view::WindowSettings LiveStage::window_settings(const Options& options) const {
  view::WindowSettings settings;
  settings.facts = facts_of(scene_);
  settings.facts.file = options.scene;
  const Overrides overrides = overrides_of(options);
  if (const auto tissue = overrides.find("tissue.default"); tissue != overrides.end()) {
    settings.facts.tissue = tissue->second;
  }
  settings.facts.note = device_notes(scene_, hands_) + scene_.note;
  settings.facts.device_peaks_N.clear();
  for (const device::DeviceProfile& profile : hands_.profiles()) {
    settings.facts.device_peaks_N.push_back(profile.peak_force_N);
    settings.facts.shows_force_only.push_back(profile.shows_force_only);
  }
  settings.hand_start_world_m = to_array(start_of_led_hand(scene_, hands_.led()));
  settings.start = start_of(scene_);
  return settings;
}

}  // namespace myotact::app
