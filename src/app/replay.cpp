#include <iostream>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "app/options.h"
#include "core/error.h"
#include "core/json_reader.h"
#include "scene/conductor.h"
#include "scene/force_replay.h"
#include "scene/recording.h"
#include "scene/recording_header.h"

namespace myotact::app {

namespace {

/// First step after which the state differs from the recorded one; the count of steps when none does.
std::size_t play_again(const scene::Recording& recording, scene::ForceReplay& hands,
                       simulation::Simulation& simulation) {
  hands.feel(simulation);
  for (std::size_t i = 0; i < recording.steps.size(); ++i) {
    scene::apply(recording.steps[i], simulation);
    simulation.step(recording.steps[i].tools);
    if (simulation.state_hash() != recording.steps[i].state_hash) return i;
    hands.feel(simulation);
  }
  return recording.steps.size();
}

}  // namespace

int replay(const Options& options) {
  const scene::Recording recording = scene::read_recording(options.file);
  const nlohmann::json header = parse_json(recording.header_json, options.file.string() + " (header)");
  const scene::Scene scene = scene::scene_of_recording(header, options.file, scene_overrides_of(options));
  scene::require_fit(recording, scene, options.file);
  if (!recording.complete) {
    spdlog::warn("{}: the recording was cut short after {} steps, by a crash or a full disk; what is there is compared",
                 options.file.string(), recording.steps.size());
  }
  simulation::Simulation simulation(scene.specimen, scene.settings);
  scene::Conductor start(scene, simulation);  // puts the simulation where the recording began
  scene::ForceReplay hands(scene, recording, scene::devices_of_recording(header, options.file));
  const std::size_t same = play_again(recording, hands, simulation);
  const scene::ForceComparison forces = hands.comparison();
  const bool equal = same == recording.steps.size() && forces.largest_difference_N == 0.0;
  std::size_t ticks = 0;
  for (const scene::ToolRecording& tool : recording.tools) ticks += tool.ticks.size();
  nlohmann::json report = {{"file", options.file.string()},
                           {"steps", recording.steps.size()},
                           {"ticks", ticks},
                           {"complete", recording.complete},
                           {"equal_steps", same},
                           {"forces_compared", forces.compared},
                           {"largest_force_difference_N", forces.largest_difference_N},
                           {"equal", equal}};
  for (std::size_t t = 0; t < hands.tool_count() && hands.tool_count() > 1; ++t) {
    report[scene.tools[t].hand + "_forces_compared"] = hands.comparison(t).compared;
    report[scene.tools[t].hand + "_largest_force_difference_N"] = hands.comparison(t).largest_difference_N;
  }
  if (options.json) {
    std::cout << report.dump(2) << std::endl;
  } else {
    for (const auto& item : report.items()) std::cout << item.key() << ": " << item.value().dump() << '\n';
    std::cout << std::flush;
  }
  return static_cast<int>(equal ? ExitStatus::Done : ExitStatus::CheckFailed);
}

}  // namespace myotact::app
