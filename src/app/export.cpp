#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/interruption.h"
#include "app/options.h"
#include "app/picture.h"
#include "core/error.h"
#include "core/file.h"
#include "scene/lockstep_session.h"
#include "scene/samples.h"
#include "view/ui/text.h"

namespace myotact::app {

namespace {

constexpr const char* kPosterSize = "3840x2160";

enum class Kind { Poster };

Kind kind_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".png") return Kind::Poster;
  throw Error(ExitStatus::Usage, fmt::format("--out {}: must end in .png (a poster)", file.string()));
}

/// A poster has its names and no lines over them, unless it was asked for otherwise.
PictureWish poster_wish(const Options& options) {
  PictureWish wish{
      options.view, {"labels=on", "lines=off"}, view::picture_size_of(options.export_size.value_or(kPosterSize))};
  // Specimens hold English and Latin names.
  if (options.language.value_or("en") != "en") wish.show.emplace_back("names=latin");
  wish.show.insert(wish.show.end(), options.show.begin(), options.show.end());
  return wish;
}

/// The limb in balance, and then what the script makes of it.
void play(const Options& options, const scene::Scene& scene, simulation::Simulation& simulation) {
  constexpr int kFewSamples = 1000000;  // nobody reads them
  scene::SampleTable samples(scene.specimen, scene::hands_of(scene), kFewSamples);
  scene::LockstepSession session(scene, simulation, samples, nullptr);
  const double steps = options.seconds.value_or(0.0) / scene.settings.dt_s;
  for (std::int64_t i = 0; i < std::llround(steps) && interruption() == 0; ++i) session.step();
}

}  // namespace

int export_scene(const Options& options) {
  kind_of(options.file);
  if (options.language) view::ui::set_language(*options.language);
  const scene::Scene scene = scene_of(options);
  const PictureWish wish = poster_wish(options);
  check_picture(scene, wish);
  require_writable(options.file);
  watch_for_interruption();
  simulation::Simulation simulation(scene.specimen, scene.settings);
  play(options, scene, simulation);
  if (interruption() != 0) return interruption();
  // Without its tools: nobody touches what hangs on a wall.
  write_picture(scene, simulation, {}, wish, options.file);
  spdlog::info("{}: {} x {} pixels", options.file.string(), wish.size.width, wish.size.height);
  return interruption();
}

}  // namespace myotact::app
