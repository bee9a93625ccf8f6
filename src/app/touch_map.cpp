#include "measure/fidelity/touch_map.h"

#include <iostream>
#include <optional>
#include <vector>

#include <spdlog/spdlog.h>

#include "app/fidelity_input.h"
#include "app/interruption.h"
#include "app/touch_map_page.h"
#include "core/error.h"
#include "core/file.h"
#include "measure/fidelity/touch_map_report.h"

namespace myotact::app {

namespace {

measure::TouchMapRequest request_of(const Options& options) {
  const std::optional<device::NamedProfile> named = named_profile(options);
  const device::NamedProfile device = named ? *named : device::load_profile("simulated");
  return {device.name, device.profile, options.places, options.seed};
}

scene::Scene limb_of(const Options& options) {
  scene::Scene scene = scene::load_scene(options.scene, scene_overrides_of(options));
  if (scene.settings.tether || scene.specimen.muscles.empty())
    throw bad_data(scene.name, "/specimen", "has no muscle that a hand can touch; name a limb, such as elbow");
  scene.settings.workers = options.workers;
  return scene;
}

/// None where nothing can be drawn.
std::vector<TouchPicture> pictures_if_any(const anatomy::Specimen& specimen, const measure::TouchMap& map) {
  try {
    return touch_pictures(specimen, map);
  } catch (const Error& error) {
    if (error.status() != ExitStatus::Unavailable) throw;
    spdlog::warn("{}", error.what());
    return {};
  }
}

}  // namespace

int touch_map(const Options& options) {
  const measure::TouchMapRequest request = request_of(options);
  const scene::Scene scene = limb_of(options);
  make_writable_folder(options.out);
  Progress progress;
  const measure::TouchMap map = measure::map_touch(scene, request, watch_until_interrupted(progress));
  const std::vector<TouchPicture> pictures = pictures_if_any(scene.specimen, map);
  const std::string json = measure::touch_map_json(map);
  write_file(options.out / "touch_map.json", json);
  write_file(options.out / "touch_map.csv", measure::touch_map_csv(map));
  write_file(options.out / "touch_map.html", touch_map_page(map, pictures));
  for (const TouchPicture& picture : pictures)
    view::write_png(options.out / ("touch_map_" + picture.side + ".png"), picture.image);
  std::cout << (options.json ? json : measure::touch_map_text(map)) << std::flush;
  if (interruption() != 0) return interruption();
  return static_cast<int>(measure::places_of(map, measure::Grade::Poor) == 0 ? ExitStatus::Done
                                                                             : ExitStatus::CheckFailed);
}

}  // namespace myotact::app
