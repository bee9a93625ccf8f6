#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/export_elements.h"
#include "app/export_play.h"
#include "app/interruption.h"
#include "app/options.h"
#include "app/picture.h"
#include "app/progress.h"
#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "exchange/opensim.h"
#include "exchange/vtk_scene.h"
#include "geometry/glb.h"
#include "view/pictures/limb_model.h"
#include "view/pictures/moving_limb_model.h"
#include "view/pictures/turntable.h"
#include "view/ui/text.h"

namespace myotact::app {

namespace {

constexpr double kTurn_s = 12.0;   // slow enough to read a limb by
constexpr int kMostFrames = 1200;  // of a model that moves, a minute: they are kept until it is written

enum class Kind { Poster, Film, Model, Tissue, Surfaces, Series, Elements, OpenSim };

/// What the name of the file asks for.
struct Format {
  const char* extension;
  Kind kind;
  const char* what;
  const char* size = "1920x1080";  // without --size; what is no picture needs none
};
constexpr std::array kFormats{
    Format{".png", Kind::Poster, "a poster", "3840x2160"},
    Format{".mp4", Kind::Film, "a film once round the limb"},
    Format{".glb", Kind::Model, "a 3D model, glTF 2.0"},
    Format{".vtu", Kind::Tissue, "the muscles' tetrahedra with their values, for ParaView"},
    Format{".vtp", Kind::Surfaces, "skins and bones with their values, for ParaView"},
    Format{".pvd", Kind::Series, "both of these at every frame of the script, for ParaView"},
    Format{".feb", Kind::Elements, "muscles as finite elements, for FEBio"},
    Format{".osim", Kind::OpenSim, "bones, joints and muscle lines, for OpenSim 4"},
};

bool is_picture(Kind kind) {
  return kind == Kind::Poster || kind == Kind::Film;
}
/// Drawn, or built from what is drawn: the view decides what is in it.
bool is_seen(Kind kind) {
  return is_picture(kind) || kind == Kind::Model;
}

const Format& format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
  }
  std::vector<std::string> known;
  for (const Format& format : kFormats) known.push_back(fmt::format("{} ({})", format.extension, format.what));
  throw Error(ExitStatus::Usage,
              fmt::format("--out {}: ends in \"{}\"; must end in one of {}", file.string(), extension, join(known)));
}

void refuse_unfitting(const Options& options, Kind kind) {
  const auto refuse = [&](bool given, const char* option, const char* what) {
    if (!given) return;
    throw Error(ExitStatus::Usage,
                fmt::format("{}: {}, and --out {} is none; leave it out", option, what, options.file.string()));
  };
  refuse(options.turn_s.has_value() && kind != Kind::Film, "--turn", "is of a film (.mp4)");
  refuse(options.language.has_value() && kind != Kind::Poster, "--language", "is of a poster (.png)");
  refuse(options.export_size.has_value() && !is_picture(kind), "--size", "is of a picture (.png) or film (.mp4)");
  refuse(options.frame_steps.has_value() && kind != Kind::Model && kind != Kind::Series, "--every",
         "is of what moves (.glb with --seconds, .pvd)");
  refuse(options.muscle.has_value() && kind != Kind::Elements, "--muscle", "is of finite elements (.feb)");
  refuse(!options.show.empty() && !is_seen(kind), "--show", "is of what is looked at (.png, .mp4, .glb)");
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
  const double frames = options.seconds.value_or(0.0) / (scene.settings.dt_s * steps_between_frames(options, scene));
  if (kind == Kind::Model && frames > kMostFrames) {
    throw Error(ExitStatus::Usage,
                fmt::format("--seconds {}: are {:.0f} frames, and a model that moves has at most {}; "
                            "give fewer seconds, or a larger --every",
                            to_text(*options.seconds), frames, kMostFrames));
  }
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
messages::SceneFrame frame_of(const simulation::Simulation& simulation) {
  messages::SceneFrame frame;
  simulation.write_frame(frame);
  frame.tools.clear();
  return frame;
}

/// The specimen itself, with its universal and ball joints, and with the scene's own lines and fibre lengths.
void write_opensim(const Options& options, const scene::Scene& scene) {
  anatomy::Specimen specimen = anatomy::load_specimen(scene.specimen_folder);
  specimen.lines = scene.specimen.lines;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    specimen.muscles[m].rest_stretch = scene.specimen.muscles[m].rest_stretch;
  }
  exchange::opensim::save_model(specimen, options.file);
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

/// What is seen, as it stands at the end.
void write_seen(const Options& options, const scene::Scene& scene, const Format& format, const PictureWish& wish) {
  play(options, scene, {}, [&](const simulation::Simulation& simulation) {
    const messages::SceneFrame frame = frame_of(simulation);
    const view::ViewState look = look_of(scene, frame, wish);
    if (format.kind == Kind::Poster) write_picture(scene, frame, wish, options.file);
    if (format.kind == Kind::Film) {
      write_film(options, {scene.specimen, frame, look, wish.size, options.turn_s.value_or(kTurn_s)});
    }
    if (format.kind == Kind::Model) {
      write_file(options.file, geometry::glb_bytes(view::limb_model(scene.specimen, frame, look)));
    }
  });
}

/// The limb as it moves while the script is played.
void write_moving_model(const Options& options, const scene::Scene& scene, const PictureWish& wish) {
  std::vector<view::LimbMoment> moments;
  std::optional<view::ViewState> look;
  const auto add = [&](const simulation::Simulation& simulation) {
    const messages::SceneFrame frame = frame_of(simulation);
    if (!look) look = look_of(scene, frame, wish);
    moments.push_back({frame.time_s, frame.body_poses, frame.skins_world_m});
  };
  play(options, scene, add, {});
  if (interruption() != 0) return;
  const std::string bytes = geometry::glb_bytes(view::moving_limb_model(scene.specimen, moments, *look));
  write_file(options.file, bytes);
  spdlog::info("{}: {} frames, {:.1f} MB", options.file.string(), moments.size(),
               1e-6 * static_cast<double>(bytes.size()));
}

/// One file of VTK, as the scene is at the end.
void write_vtk_file(const Options& options, const scene::Scene& scene, Kind kind) {
  play(options, scene, {}, [&](const simulation::Simulation& simulation) {
    write_file(options.file,
               exchange::vtk_xml(kind == Kind::Tissue ? exchange::vtk_tissue(scene.specimen, simulation)
                                                      : exchange::vtk_surfaces(scene.specimen, simulation)));
  });
}

void write(const Options& options, const scene::Scene& scene, const Format& format, const PictureWish& wish) {
  switch (format.kind) {
    case Kind::Poster:
    case Kind::Film:
      return write_seen(options, scene, format, wish);
    case Kind::Model:
      return options.seconds.value_or(0.0) > 0.0 ? write_moving_model(options, scene, wish)
                                                 : write_seen(options, scene, format, wish);
    case Kind::Tissue:
    case Kind::Surfaces:
      return write_vtk_file(options, scene, format.kind);
    case Kind::Series:
      return write_series(options, scene);
    case Kind::Elements:
      return write_elements(options, scene);
    case Kind::OpenSim:
      return write_opensim(options, scene);
  }
}

}  // namespace

int export_scene(const Options& options) {
  const Format& format = format_of(options.file);
  refuse_unfitting(options, format.kind);
  if (format.kind == Kind::Elements && is_case(options.scene)) return export_case(options);
  if (options.language) view::ui::set_language(*options.language);
  const scene::Scene scene = scene_of(options);
  const PictureWish wish = wish_of(options, format);
  check(options, scene, wish, format.kind);
  watch_for_interruption();
  write(options, scene, format, wish);
  if (interruption() == 0) spdlog::info("{} is written", options.file.string());
  return interruption();
}

}  // namespace myotact::app
