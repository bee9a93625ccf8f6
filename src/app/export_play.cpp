#include "app/export_play.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/interruption.h"
#include "app/progress.h"
#include "core/file.h"
#include "exchange/vtk_scene.h"
#include "scene/lockstep_session.h"
#include "scene/samples.h"

namespace myotact::app {

namespace {

constexpr double kFrames_hz = 20.0;  // of what moves: a film's eye needs more, a file's size less

}  // namespace

int steps_between_frames(const Options& options, const scene::Scene& scene) {
  const auto usual = static_cast<int>(std::lround(1.0 / (kFrames_hz * scene.settings.dt_s)));
  return options.frame_steps.value_or(std::max(1, usual));
}

void play(const Options& options, const scene::Scene& scene, const SceneTaker& each, const SceneTaker& last) {
  constexpr int kFewSamples = 1000000;  // nobody reads them
  simulation::Simulation simulation(scene.specimen, scene.settings);
  scene::SampleTable samples(scene.specimen, scene::hands_of(scene), kFewSamples);
  scene::LockstepSession session(scene, simulation, samples, nullptr);
  const std::int64_t steps = std::llround(options.seconds.value_or(0.0) / scene.settings.dt_s);
  const int between = steps_between_frames(options, scene);
  Progress progress;
  if (each) each(simulation);
  for (std::int64_t i = 1; i <= steps && interruption() == 0; ++i) {
    session.step();
    if (each && i % between == 0) each(simulation);
    if (each) progress.show(static_cast<int>(i), static_cast<int>(steps));
  }
  if (last && interruption() == 0) last(simulation);
}

void write_series(const Options& options, const scene::Scene& scene) {
  const std::filesystem::path folder = std::filesystem::path(options.file).replace_extension();
  make_writable_folder(folder);
  std::vector<exchange::VtkSeriesEntry> entries;
  int frame = 0;
  const auto add = [&](const simulation::Simulation& simulation) {
    const std::string name = fmt::format("{}_{:05}", folder.filename().string(), frame++);
    write_file(folder / (name + ".vtu"), exchange::vtk_xml(exchange::vtk_tissue(scene.specimen, simulation)));
    write_file(folder / (name + ".vtp"), exchange::vtk_xml(exchange::vtk_surfaces(scene.specimen, simulation)));
    entries.push_back({simulation.time_s(), 0, folder.filename() / (name + ".vtu")});
    entries.push_back({simulation.time_s(), 1, folder.filename() / (name + ".vtp")});
  };
  play(options, scene, add, {});
  if (interruption() != 0) return;
  write_file(options.file, exchange::vtk_series(entries));
  spdlog::info("{}: {} frames in the folder {}", options.file.string(), frame, folder.string());
}

}  // namespace myotact::app
