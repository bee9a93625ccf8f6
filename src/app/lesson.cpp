#include <cmath>
#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "anatomy/part_facts.h"
#include "app/equipment.h"
#include "app/options.h"
#include "app/scripted_student.h"
#include "core/data_folder.h"
#include "core/error.h"
#include "core/json_reader.h"
#include "core/text.h"
#include "learn/lesson_file.h"
#include "learn/lesson_list.h"
#include "learn/lesson_results.h"
#include "scene/lockstep_session.h"
#include "scene/samples.h"

namespace myotact::app {

namespace {

/// {"schema": 1, "answers": {"2": ["brachialis", "hint", "biceps_brachii"]}}
Answers read_answers(const std::filesystem::path& path, std::size_t steps) {
  const nlohmann::json json = read_json(path);
  JsonObject object{JsonValue(json, path.string())};
  object.at("schema").integer_between(1, 1);
  JsonObject list(object.at("answers"));
  object.finish();
  Answers answers;
  for (const auto& [key, words] : list.entries()) {
    const auto number = parse_number(key);
    const bool whole =
        number && *number >= 1.0 && *number <= static_cast<double>(steps) && *number == std::floor(*number);
    if (!whole) throw words.error(fmt::format("is no step; must be a number from 1 to {}", steps));
    answers[static_cast<std::size_t>(*number)] = words.strings();
  }
  return answers;
}

void print_steps(const learn::Lesson& lesson) {
  std::cout << fmt::format("{}: {}\nscene {}, {} steps, {} points\n", lesson.key, lesson.title, lesson.scene,
                           lesson.steps.size(), to_text(learn::most_points(lesson)));
  for (std::size_t i = 0; i < lesson.steps.size(); ++i) {
    const learn::Step& step = lesson.steps[i];
    std::cout << fmt::format("{:3} {:8} {}\n", i + 1, learn::kind_of(step.task), step.title);
  }
}

void print_list() {
  for (const learn::ListedLesson& lesson : learn::list_lessons()) {
    if (lesson.complaint.empty()) {
      std::cout << fmt::format("{:24} {} (scene {}, {} steps)\n", lesson.head.key, lesson.head.title, lesson.head.scene,
                               lesson.head.steps);
    } else {
      std::cout << fmt::format("{:24} broken: {}\n", lesson.path.filename().string(), lesson.complaint);
    }
  }
}

/// The scene that the lesson names, as the file's error where there is none.
scene::Scene scene_of_lesson(const Options& options, const learn::LessonHead& head) {
  refuse_equipment(options, "a script takes the lesson here; take it by hand in \"myotact view\" with this --device");
  Options of_scene = options;
  of_scene.scene = head.scene;
  try {
    return scene_of(of_scene);
  } catch (const Error& error) {
    if (error.status() != ExitStatus::NoInput) throw;
    throw bad_data(head.file, "/scene", error.what());
  }
}

int play(const Options& options, const scene::Scene& scene, const learn::Lesson& lesson) {
  Answers answers;
  if (options.answers) answers = read_answers(*options.answers, lesson.steps.size());
  simulation::Simulation simulation(scene.specimen, scene.settings);
  constexpr int kNoSamples = 1'000'000'000;
  scene::SampleTable samples(scene.specimen, scene::hands_of(scene), kNoSamples);
  scene::LockstepSession session(scene, simulation, samples, nullptr);
  const anatomy::FactsByKey facts = anatomy::load_part_facts(data_folder() / "assets" / "canine" / "names.json");
  learn::LessonRun run(lesson, scene.specimen, facts);
  ScriptedStudent(scene, simulation, session, run).play(answers);
  std::cout << learn::results_csv(run);
  const double most = learn::most_points(lesson);
  spdlog::info("{}: {} of {} points", lesson.key, to_text(run.score()), to_text(most));
  return options.answers || run.score() >= most ? 0 : static_cast<int>(ExitStatus::CheckFailed);
}

}  // namespace

int lesson(const Options& options) {
  if (options.file.empty()) {
    print_list();
    return 0;
  }
  const std::filesystem::path path = learn::find_lesson(options.file.string());
  scene::Scene scene = scene_of_lesson(options, learn::load_lesson_head(path));
  scene.script.clear();  // the hand is the student's
  const learn::Lesson lesson = learn::load_lesson(path, scene.specimen);
  if (options.automatic || options.answers) return play(options, scene, lesson);
  print_steps(lesson);
  return 0;
}

}  // namespace myotact::app
