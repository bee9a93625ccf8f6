#include "measure/fidelity/replay_goals.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/json_reader.h"
#include "device/simulated_device.h"
#include "scene/force_replay.h"
#include "scene/free_session.h"
#include "scene/lockstep_session.h"
#include "scene/recording_header.h"
#include "simulation/simulation.h"

namespace myotact::measure {

namespace {

/// A file that goes with its scope.
class TemporaryFile {
 public:
  TemporaryFile() : path_(std::filesystem::temp_directory_path() / fmt::format("myotact_replay_{}.rec", ::getpid())) {}
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void record(const scene::Scene& scene, double end_s, const std::filesystem::path& path) {
  scene::RecordingWriter writer(path, scene::recording_header(scene, 1, {device::DeviceProfile{}}));
  simulation::Simulation simulation(scene.specimen, scene.settings);
  scene::SampleTable samples(scene.specimen, scene::hands_of(scene), 1'000'000);
  scene::LockstepSession session(scene, simulation, samples, &writer);
  const double length_s = std::min(end_s, session.conductor().script_end_s());
  const auto steps = static_cast<int>(std::llround(length_s / scene.settings.dt_s));
  for (int step = 0; step < steps; ++step) session.step();
  writer.close();
}

/// The same with its own threads: when models arrive is up to the scheduler, and recorded.
void record_free(const scene::Scene& scene, double seconds, const std::filesystem::path& path) {
  device::SimulatedDevice device(scene.tools.front().device, scene::start_of_hand(scene, 0));
  scene::RecordingWriter writer(path, scene::recording_header(scene, 1, {device.profile()}));
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const scene::ToolDevice tool{&device, &device};
  scene::FreeSession session(scene, simulation, {&tool, 1}, &writer);
  session.start();
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  session.stop();
  writer.close();
}

struct Comparison {
  std::size_t compared = 0, unlike_states = 0;
  double largest_difference_N = 0.0, largest_force_N = 0.0;
};

Comparison feel_again(const std::filesystem::path& path) {
  const scene::Recording recording = scene::read_recording(path);
  const nlohmann::json header = parse_json(recording.header_json, path.string());
  const scene::Scene scene = scene::scene_of_recording(header, path, {});
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const scene::Conductor start(scene, simulation);
  scene::ForceReplay hand(scene, recording, scene::devices_of_recording(header, path));
  Comparison result;
  hand.feel(simulation);
  for (const scene::StepRecord& step : recording.steps) {
    scene::apply(step, simulation);
    simulation.step(step.tools);
    result.unlike_states += simulation.state_hash() != step.state_hash ? 1 : 0;
    hand.feel(simulation);
  }
  const scene::ForceComparison forces = hand.comparison();
  result.compared = forces.compared;
  result.largest_difference_N = forces.largest_difference_N;
  result.largest_force_N = forces.largest_force_N;
  return result;
}

}  // namespace

GoalFigures measure_replay(Effort effort) {
  const TemporaryFile file;
  Overrides overrides;
  if (effort == Effort::Short) overrides["tissue.default"] = "line";
  record(scene::load_scene("elbow", overrides), effort == Effort::Short ? 6.0 : 3600.0, file.path());
  const Comparison same = feel_again(file.path());
  record_free(scene::load_scene("elbow", {{"tissue.default", "line"}}), effort == Effort::Short ? 2.0 : 10.0,
              file.path());
  const Comparison free = feel_again(file.path());
  GoalFigures result;
  result.figures = {
      {"largest difference of a force, same build", 1e6 * same.largest_difference_N, "uN", 0.0},
      {"the same, recorded on the wall clock", 1e6 * free.largest_difference_N, "uN", 0.0},
      {"steps whose state differs", static_cast<double>(same.unlike_states + free.unlike_states), "", 0.0},
      {"steps whose force was compared", static_cast<double>(same.compared), "", 100.0, true},
      {"largest force that was felt", same.largest_force_N, "N", 0.1, true}};
  result.note =
      "scene elbow: touch, slide, line drag, co-contraction; forces compared where a step took them. Across compilers: "
      "tests/replay/touch_trace.csv, within 1 uN in g++ and in clang builds";
  return result;
}

}  // namespace myotact::measure
