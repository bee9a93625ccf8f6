#include "app/options.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/number_list.h"
#include "core/text.h"
#include "device/profile_file.h"
#include "scene/recording_header.h"

namespace myotact::app {

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

scene::Scene scene_of(const Options& options) {
  scene::Scene scene = scene::load_scene(options.scene, overrides_of(options));
  scene.settings.workers = options.workers;
  if (options.devices.size() > scene.tools.size()) {
    throw Error(
        ExitStatus::Usage,
        fmt::format("--device: {} devices named, but the scene \"{}\" has {} tool{}; name one a tool, in the order "
                    "of the scene's /tools",
                    options.devices.size(), scene.name, scene.tools.size(), scene.tools.size() == 1 ? "" : "s"));
  }
  static const std::vector<std::string> kKnown = {"simulated", "mouse"};
  for (const std::string& name : options.devices) {
    if (name.starts_with("simulated:")) {
      device::simulated_profile(name);  // throws where there is none
      continue;
    }
    if (std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end()) continue;
    throw Error(ExitStatus::Unavailable, "--device " + name + ": there is no such device; \"myotact devices\" lists " +
                                             join(kKnown) + " (nearest: " + nearest_word(name, kKnown) + ")");
  }
  if (std::count(options.devices.begin(), options.devices.end(), "mouse") > 1) {
    throw Error(ExitStatus::Usage, "--device: there is one mouse; name it once");
  }
  for (std::size_t t = 0; t < options.devices.size(); ++t) scene.tools[t].device = options.devices[t];
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
