#include "app/options.h"

#include "core/error.h"

namespace myotact::app {

scene::Overrides overrides_of(const Options& options) {
  scene::Overrides overrides;
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
  if (options.devices.size() > 1) {
    throw Error(ExitStatus::Usage, "--device: more than one tool is not in this version; name one device");
  }
  if (!options.devices.empty()) scene.tools.front().device = options.devices.front();
  return scene;
}

}  // namespace myotact::app
