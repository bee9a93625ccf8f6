#include <algorithm>
#include <array>
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
#include "app/progress.h"
#include "core/error.h"
#include "core/file.h"
#include "exchange/opensim.h"
#include "geometry/glb.h"
#include "scene/lockstep_session.h"
#include "scene/samples.h"
#include "view/pictures/limb_model.h"
#include "view/pictures/turntable.h"
#include "view/ui/text.h"

namespace myotact::app {

namespace {

constexpr double kTurn_s = 12.0;  // slow enough to read a limb by

enum class Kind { Poster, Film, Model, OpenSim };

/// What the name of the file asks for.
struct Format {
  const char* extension;
  Kind kind;
  const char* size;  // without --size; a model has none
};
constexpr std::array<Format, 4> kFormats{{{".png", Kind::Poster, "3840x2160"},
                                          {".mp4", Kind::Film, "1920x1080"},
                                          {".glb", Kind::Model, "1920x1080"},
                                          {".osim", Kind::OpenSim, "1920x1080"}}};

const Format& format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
  }
  throw Error(ExitStatus::Usage,
              fmt::format("--out {}: ends in \"{}\"; must end in .png (a poster), .mp4 (a film once round the limb), "
                          ".glb (a 3D model, glTF 2.0) or .osim (a model of OpenSim 4)",
                          file.string(), extension));
}

void refuse_unfitting(const Options& options, Kind kind) {
  const auto refuse = [&](bool given, const char* option, const char* what) {
    if (!given) return;
    throw Error(ExitStatus::Usage,
                fmt::format("{}: {}, and --out {} is none; leave it out", option, what, options.file.string()));
  };
  refuse(options.turn_s.has_value() && kind != Kind::Film, "--turn", "is of a film (.mp4)");
  refuse(options.language.has_value() && kind != Kind::Poster, "--language", "is of a poster (.png)");
  refuse(options.export_size.has_value() && kind >= Kind::Model, "--size", "is of a picture (.png) or film (.mp4)");
}

/// Muscle lines are asked for: they hide what a poster and a film show.
PictureWish wish_of(const Options& options, const Format& format) {
  PictureWish wish{options.view, {"lines=off"}, view::picture_size_of(options.export_size.value_or(format.size))};
  wish.poster = format.kind == Kind::Poster;
  if (wish.poster) wish.show.emplace_back("labels=on");
  // Specimens hold English and Latin names.
  if (options.language.value_or("en") != "en") wish.show.emplace_back("names=latin");
  wish.show.insert(wish.show.end(), options.show.begin(), options.show.end());
  return wish;
}

/// Before anything is simulated.
void check(const Options& options, const scene::Scene& scene, const PictureWish& wish, Kind kind) {
  check_picture(scene, wish);
  require_writable(options.file);
  if (kind != Kind::Film) return;
  view::check_film_size(wish.size);
  view::ffmpeg_for_films();
  if (look_of(scene, {}, wish).labels) {
    throw Error(ExitStatus::Usage,
                "--show labels=on: names would jump from place to place as the limb turns; a film "
                "has none, a poster (.png) has them");
  }
}

/// The limb in balance, and then what the script makes of it. Without its tools: nobody touches what hangs on a wall.
messages::SceneFrame frame_after(const Options& options, const scene::Scene& scene) {
  constexpr int kFewSamples = 1000000;  // nobody reads them
  simulation::Simulation simulation(scene.specimen, scene.settings);
  scene::SampleTable samples(scene.specimen, scene::hands_of(scene), kFewSamples);
  scene::LockstepSession session(scene, simulation, samples, nullptr);
  const std::int64_t steps = std::llround(options.seconds.value_or(0.0) / scene.settings.dt_s);
  for (std::int64_t i = 0; i < steps && interruption() == 0; ++i) session.step();
  messages::SceneFrame frame;
  simulation.write_frame(frame);
  frame.tools.clear();
  return frame;
}

/// The specimen itself, with its universal and ball joints, and with the scene's own lines and fibre lengths.
void write_opensim(const Options& options, const scene::Scene& scene) {
  require_writable(options.file);
  anatomy::Specimen specimen = anatomy::load_specimen(scene.specimen_folder);
  specimen.lines = scene.specimen.lines;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    specimen.muscles[m].rest_stretch = scene.specimen.muscles[m].rest_stretch;
  }
  exchange::opensim::save_model(specimen, options.file);
  spdlog::info("{} is written", options.file.string());
}

void write_film(const Options& options, const view::Turntable& turntable) {
  Progress progress;
  const auto go_on = [&](int done, int all) {
    progress.show(done, all);
    return interruption() == 0;
  };
  try {
    view::write_turntable(turntable, options.file, go_on);
  } catch (const Error&) {
    if (interruption() == 0) throw;  // Ctrl-C ends ffmpeg as well
  }
}

}  // namespace

int export_scene(const Options& options) {
  const Format& format = format_of(options.file);
  refuse_unfitting(options, format.kind);
  if (options.language) view::ui::set_language(*options.language);
  const scene::Scene scene = scene_of(options);
  if (format.kind == Kind::OpenSim) {
    write_opensim(options, scene);
    return static_cast<int>(ExitStatus::Done);
  }
  const PictureWish wish = wish_of(options, format);
  check(options, scene, wish, format.kind);
  watch_for_interruption();
  const messages::SceneFrame frame = frame_after(options, scene);
  if (interruption() != 0) return interruption();
  const view::ViewState look = look_of(scene, frame, wish);
  switch (format.kind) {
    case Kind::Poster:
      write_picture(scene, frame, wish, options.file);
      break;
    case Kind::Film:
      write_film(options, {scene.specimen, frame, look, wish.size, options.turn_s.value_or(kTurn_s)});
      break;
    case Kind::Model:
      write_file(options.file, geometry::glb_bytes(view::limb_model(scene.specimen, frame, look)));
      break;
    case Kind::OpenSim:
      break;  // needs no frame
  }
  if (interruption() == 0) spdlog::info("{} is written", options.file.string());
  return interruption();
}

}  // namespace myotact::app
