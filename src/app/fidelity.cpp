#include <filesystem>
#include <iostream>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "app/fidelity_input.h"
#include "app/fidelity_page.h"
#include "app/interruption.h"
#include "app/options.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "device/profile_file.h"
#include "measure/fidelity/scene_fidelity_report.h"
#include "measure/fidelity/suite_report.h"
#include "scene/recording_header.h"

namespace myotact::app {

namespace {

int suite(const Options& options) {
  const auto effort = options.brief ? measure::Effort::Short : measure::Effort::Full;
  std::vector<measure::MeasuredGoal> measured;
  bool passed = true;
  for (const measure::Goal& goal : measure::select_goals(options.goals)) {
    spdlog::info("goal {}: {}", goal.number, goal.title);
    measured.push_back(measure::measure_goal(goal, effort));
    passed = passed && measured.back().passed();
    if (!options.json) std::cout << measure::goal_text(measured.back()) << std::flush;
  }
  if (options.json) std::cout << measure::suite_json(measured) << std::flush;
  return static_cast<int>(passed ? ExitStatus::Done : ExitStatus::CheckFailed);
}

/// What is measured and on what.
struct Subject {
  scene::Scene scene;
  device::NamedProfile device;
  std::optional<scene::Recording> recording;
};

Subject subject_of(const Options& options) {
  Subject subject;
  const std::optional<device::NamedProfile> named = named_profile(options);
  if (named) subject.device = *named;
  if (options.recording) {
    subject.recording = scene::read_recording(*options.recording);
    const nlohmann::json header = parse_json(subject.recording->header_json, options.recording->string() + " (header)");
    subject.scene = scene::scene_of_recording(header, *options.recording, scene_overrides_of(options));
    scene::require_fit(*subject.recording, subject.scene, *options.recording);
    if (!named)
      subject.device = {"recorded", "the recorded device",
                        scene::devices_of_recording(header, *options.recording).front()};
  } else {
    subject.scene = scene::load_scene(options.scene, scene_overrides_of(options));
    scene::set_seed(subject.scene, options.seed);
    if (!named) subject.device = device::load_profile("simulated");
  }
  subject.scene.settings.workers = options.workers;
  return subject;
}

int scene_fidelity(const Options& options) {
  measure::FidelityRequest request;
  if (!options.plant.empty()) request.planted = measure::parse_planted_faults(options.plant);
  request.truth = options.truth == "steps" ? measure::Truth::Steps : measure::Truth::Ticks;
  const Subject subject = subject_of(options);
  if (subject.scene.settings.tether) {
    throw bad_data(subject.scene.name, "/original", "has one spring and no touch to grade; name a limb, such as elbow");
  }
  request.device = subject.device.name;
  request.profile = subject.device.profile;
  if (options.seconds) request.seconds = *options.seconds;
  if (subject.recording) request.recording = &*subject.recording;
  make_writable_folder(options.out);
  Progress progress;
  const measure::SceneFidelity found =
      measure::measure_scene_fidelity(subject.scene, request, watch_until_interrupted(progress));
  const std::string json = measure::scene_fidelity_json(found);
  write_file(options.out / "fidelity.json", json);
  write_file(options.out / "fidelity.csv", measure::scene_fidelity_csv(found));
  write_file(options.out / "fidelity.html", fidelity_page(found));
  std::cout << (options.json ? json : measure::scene_fidelity_text(found)) << std::flush;
  if (interruption() != 0) return interruption();
  const bool passed =
      found.planted ? found.planted->all_found() : measure::worst_grade(measure::grade(found)) < measure::Grade::Poor;
  return static_cast<int>(passed ? ExitStatus::Done : ExitStatus::CheckFailed);
}

}  // namespace

int fidelity(const Options& options) {
  if (options.suite || !options.goals.empty()) return suite(options);
  if (options.map) return touch_map(options);
  // Asked for with a path, faults or a device of one's own, a scene of the layer is measured as any other.
  const bool as_any = options.recording || !options.plant.empty() || !options.devices.empty();
  const std::optional<int> of_layer = as_any ? std::nullopt : layer_fidelity(options);
  return of_layer ? *of_layer : scene_fidelity(options);
}

}  // namespace myotact::app
