#include <iostream>

#include <nlohmann/json.hpp>

#include "app/options.h"
#include "core/error.h"
#include "core/json_reader.h"
#include "scene/conductor.h"
#include "scene/force_replay.h"
#include "scene/recording.h"

namespace myotact::app {

namespace {

/// First step after which the state differs from the recorded one; the count of steps when none does.
std::size_t play_again(const scene::Recording& recording, scene::ForceReplay& hand,
                       simulation::Simulation& simulation) {
  hand.feel(simulation);
  for (std::size_t i = 0; i < recording.steps.size(); ++i) {
    scene::apply(recording.steps[i], simulation);
    simulation.step({&recording.steps[i].tool, 1});
    if (simulation.state_hash() != recording.steps[i].state_hash) return i;
    hand.feel(simulation);
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
  scene::ForceReplay hand(scene, recording, scene::device_of_recording(header, options.file));
  const std::size_t same = play_again(recording, hand, simulation);
  const bool equal = same == recording.steps.size() && hand.largest_difference_N() == 0.0;
  const nlohmann::json report = {{"file", options.file.string()},
                                 {"steps", recording.steps.size()},
                                 {"ticks", recording.ticks.size()},
                                 {"complete", recording.complete},
                                 {"equal_steps", same},
                                 {"forces_compared", hand.compared()},
                                 {"largest_force_difference_N", hand.largest_difference_N()},
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
