#include "app/options.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/number_list.h"
#include "core/text.h"
#include "device/drivers/driver_table.h"
#include "device/profile_file.h"
#include "scene/recording_header.h"

namespace myotact::app {

namespace {

const std::vector<std::string> kWithoutHardware = {"simulated", "mouse"};

void check_name(const std::string& name) {
  if (name.starts_with("simulated:")) {
    device::simulated_profile(name);  // throws where there is none
    return;
  }
  if (device::is_on_the_table(name)) return;
  if (std::find(kWithoutHardware.begin(), kWithoutHardware.end(), name) != kWithoutHardware.end()) return;
  std::vector<std::string> known = kWithoutHardware;
  known.insert(known.end(), device::driver_names().begin(), device::driver_names().end());
  throw Error(ExitStatus::Unavailable, "--device " + name + ": there is no such device; \"myotact devices\" lists " +
                                           join(known) + " (nearest: " + nearest_word(name, known) + ")");
}

/// The tool that a device is for: of the hand that is said, else the first without a device.
std::size_t tool_of(scene::Scene& scene, const std::string& hand, const std::vector<bool>& taken) {
  if (scene.tools.size() == 1 && !hand.empty()) scene.tools[0].hand = hand;  // a left-handed person leads with the left
  for (std::size_t t = 0; t < scene.tools.size() && !hand.empty(); ++t) {
    if (scene.tools[t].hand == hand) return t;
  }
  return static_cast<std::size_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
}

/// `devices`: at most as many as there are tools.
void give_devices(std::vector<NamedDevice> devices, scene::Scene& scene) {
  std::stable_partition(devices.begin(), devices.end(), [](const NamedDevice& device) { return !device.hand.empty(); });
  std::vector<bool> taken(scene.tools.size(), false);
  for (const NamedDevice& device : devices) {
    const std::size_t tool = tool_of(scene, device.hand, taken);
    if (taken[tool]) {
      throw Error(ExitStatus::Usage, fmt::format("--device: the {} hand gets two devices; say of each of them which "
                                                 "hand it is for, as left=touch,right=touch:2",
                                                 scene.tools[tool].hand));
    }
    taken[tool] = true;
    scene.tools[tool].device = device.name;
  }
}

}  // namespace

Overrides overrides_of(const Options& options) {
  Overrides overrides;
  for (const std::string& pair : options.set) {
    const std::size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error(ExitStatus::Usage, "--set " + pair + ": must be key=value, for example --set specimen=/path/to/it");
    }
    overrides[pair.substr(0, equals)] = pair.substr(equals + 1);
  }
  return overrides;
}

std::vector<NamedDevice> named_devices(const Options& options) {
  std::vector<NamedDevice> devices;
  for (const std::string& text : options.devices) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      devices.push_back({"", text});
      continue;
    }
    devices.push_back({text.substr(0, equals), text.substr(equals + 1)});
    if (devices.back().hand == "left" || devices.back().hand == "right") continue;
    throw Error(ExitStatus::Usage, "--device " + text + ": must be NAME, left=NAME or right=NAME");
  }
  return devices;
}

void take_devices(const Options& options, scene::Scene& scene) {
  const std::vector<NamedDevice> devices = named_devices(options);
  if (devices.size() > scene.tools.size()) {
    throw Error(
        ExitStatus::Usage,
        fmt::format("--device: {} devices named, but the scene \"{}\" has {} tool{}; name one a tool, in the order "
                    "of the scene's /tools",
                    devices.size(), scene.name, scene.tools.size(), scene.tools.size() == 1 ? "" : "s"));
  }
  for (const NamedDevice& device : devices) check_name(device.name);
  if (std::count_if(devices.begin(), devices.end(), [](const NamedDevice& device) { return device.name == "mouse"; }) >
      1) {
    throw Error(ExitStatus::Usage, "--device: there is one mouse; name it once");
  }
  give_devices(devices, scene);
}

Overrides scene_overrides_of(const Options& options) {
  Overrides overrides = overrides_of(options);
  std::erase_if(overrides, [](const auto& pair) { return device::is_device_setting(pair.first); });
  return overrides;
}

scene::Scene scene_of(const Options& options) {
  scene::Scene scene = scene::load_scene(options.scene, scene_overrides_of(options));
  scene.settings.workers = options.workers;
  take_devices(options, scene);
  scene::set_seed(scene, options.seed);
  return scene;
}

std::vector<double> levels_of(const Options& options) {
  const auto levels = parse_number_list("--levels", options.levels);
  for (const double level : levels) {
    if (level >= 0.0 && level <= 1.0) continue;
    throw Error(ExitStatus::Usage, "--levels: " + to_text(level) +
                                       " is no level of co-contraction; must be in 0 .. 1, which is full activation");
  }
  return levels;
}

std::unique_ptr<scene::RecordingWriter> open_recorder(const Options& options, const scene::Scene& scene,
                                                      const std::vector<device::DeviceProfile>& profiles) {
  if (!options.record) return nullptr;
  return std::make_unique<scene::RecordingWriter>(*options.record,
                                                  scene::recording_header(scene, options.seed, profiles));
}

}  // namespace myotact::app
