#include <iostream>

#include <nlohmann/json.hpp>

#include "app/options.h"
#include "core/error.h"
#include "core/json_reader.h"
#include "scene/conductor.h"
#include "scene/recording.h"

namespace myotact::app {

namespace {

/// First step after which the state differs from the recorded one; the count of steps when none does.
std::size_t first_difference(const scene::Recording& recording, simulation::Simulation& simulation) {
  for (std::size_t i = 0; i < recording.steps.size(); ++i) {
    const scene::StepRecord& step = recording.steps[i];
    scene::apply(step, simulation);
    simulation.step({&step.tool, 1});
    if (simulation.state_hash() != step.state_hash) return i;
  }
  return recording.steps.size();
}

}  // namespace

int replay(const Options& options) {
  const scene::Recording recording = scene::read_recording(options.file);
  const nlohmann::json header = parse_json(recording.header_json, options.file.string() + " (header)");
  const scene::Scene scene = scene::scene_of_recording(header, options.file, overrides_of(options));
  scene::require_fit(recording, scene.specimen, options.file);
  simulation::Simulation simulation(scene.specimen, scene.settings);
  scene::Conductor start(scene, simulation);  // puts the simulation where the recording began
  const std::size_t same = first_difference(recording, simulation);
  const bool equal = same == recording.steps.size();
  const nlohmann::json report = {{"file", options.file.string()},
                                 {"steps", recording.steps.size()},
                                 {"ticks", recording.ticks.size()},
                                 {"complete", recording.complete},
                                 {"equal_steps", same},
                                 {"equal", equal}};
  if (options.json) {
    std::cout << report.dump(2) << std::endl;
  } else {
    for (const auto& item : report.items()) std::cout << item.key() << ": " << item.value().dump() << '\n';
    std::cout << std::flush;
  }
  return static_cast<int>(equal ? ExitStatus::Done : ExitStatus::CheckFailed);
}

}  // namespace myotact::app
