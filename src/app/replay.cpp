#include <algorithm>
#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/options.h"
#include "core/error.h"
#include "core/json_reader.h"
#include "scene/conductor.h"
#include "scene/force_replay.h"
#include "scene/recording.h"

namespace myotact::app {

namespace {

/// What came out again.
struct Comparison {
  std::size_t equal_steps = 0;              // before the first state that differs
  std::optional<double> largest_force_N{};  // difference over all steps; nothing: ticks of the wall clock
};

Comparison play_again(const scene::Scene& scene, const scene::Recording& recording, bool feels,
                      simulation::Simulation& simulation) {
  Comparison result;
  std::optional<scene::ForceReplay> hand;
  if (feels) {
    hand.emplace(scene, recording, simulation);
    result.largest_force_N = 0.0;
  }
  for (const scene::StepRecord& step : recording.steps) {
    if (hand) {
      hand->run_ticks();
      result.largest_force_N = std::max(*result.largest_force_N, scene::force_difference_N(hand->tool(), step.tool));
    }
    scene::apply(step, simulation);
    simulation.step({&step.tool, 1});
    if (simulation.state_hash() != step.state_hash) break;
    ++result.equal_steps;
    if (hand) hand->publish_model();
  }
  return result;
}

}  // namespace

int replay(const Options& options) {
  const scene::Recording recording = scene::read_recording(options.file);
  const nlohmann::json header = parse_json(recording.header_json, options.file.string() + " (header)");
  const scene::Scene scene = scene::scene_of_recording(header, options.file, overrides_of(options));
  scene::require_fit(recording, scene.specimen, options.file);
  simulation::Simulation simulation(scene.specimen, scene.settings);
  scene::Conductor start(scene, simulation);  // puts the simulation where the recording began
  const bool feels = scene::clock_of_recording(header, options.file) == scene::Clock::Virtual;
  const Comparison same = play_again(scene, recording, feels, simulation);
  const bool equal = same.equal_steps == recording.steps.size() && same.largest_force_N.value_or(0.0) == 0.0;
  nlohmann::json report = {{"file", options.file.string()},   {"steps", recording.steps.size()},
                           {"ticks", recording.ticks.size()}, {"complete", recording.complete},
                           {"equal_steps", same.equal_steps}, {"equal", equal}};
  if (same.largest_force_N) report["largest_force_difference_N"] = *same.largest_force_N;
  if (options.json) {
    std::cout << report.dump(2) << std::endl;
  } else {
    for (const auto& item : report.items()) std::cout << item.key() << ": " << item.value().dump() << '\n';
    std::cout << std::flush;
  }
  return static_cast<int>(equal ? ExitStatus::Done : ExitStatus::CheckFailed);
}

}  // namespace myotact::app
