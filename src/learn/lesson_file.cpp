#include "learn/lesson_file.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "core/json_reader.h"
#include "learn/read_task.h"

namespace myotact::learn {

namespace {

constexpr int kSchema = 1;
constexpr std::size_t kLongestFile_bytes = std::size_t{1} << 20;  // a hundred times the longest shipped lesson

std::string read_text(const JsonValue& value, std::size_t longest) {
  std::string text = value.string();
  if (text.find_first_not_of(" \t\n") == std::string::npos) throw value.error("is empty; write what is to be shown");
  if (text.size() > longest) {
    throw value.error(fmt::format("has {} letters; must have at most {}, so that it fits", text.size(), longest));
  }
  return text;
}

constexpr std::size_t kTitle = 120, kText = 4000;

std::vector<Part> read_parts(const JsonValue& list, const anatomy::Specimen& specimen) {
  std::vector<Part> parts;
  for (const JsonValue& element : list.elements()) parts.push_back(require_part(element, specimen));
  return parts;
}

Show read_show(const JsonValue& value, const anatomy::Specimen& specimen) {
  JsonObject object(value);
  Show show;
  if (const auto muscles = object.find("muscles")) {
    show.muscles.emplace();
    for (const JsonValue& key : muscles->elements()) show.muscles->push_back(require_muscle(key, specimen));
  }
  if (const auto bones = object.find("bones")) {
    show.bones.emplace();
    for (const JsonValue& key : bones->elements()) show.bones->push_back(require_bone(key, specimen));
  }
  if (const auto faded = object.find("faded")) show.faded = read_parts(*faded, specimen);
  if (const auto colour = object.find("colour")) show.colour = colour->one_of(colour_names());
  show.labels = object.boolean_or("labels", false);
  object.finish();
  return show;
}

Setting read_setting(const JsonValue& value) {
  JsonObject object(value);
  Setting set;
  const auto number = [&](const char* key, double lowest) -> std::optional<double> {
    const auto found = object.find(key);
    return found ? std::optional(found->number_between(lowest, 1.0)) : std::nullopt;
  };
  set.common = number("common", 0.0);
  set.difference = number("difference", -1.0);
  set.flexors = number("flexors", 0.0);
  set.extensors = number("extensors", 0.0);
  if (set.flexors.has_value() != set.extensors.has_value()) {
    throw value.error("levels come in pairs; give both \"flexors\" and \"extensors\"");
  }
  if (set.flexors && (set.common || set.difference)) {
    throw value.error("give either levels (\"flexors\", \"extensors\") or a balance (\"common\", \"difference\")");
  }
  if (const auto hold = object.find("hold_posture")) set.hold_posture = hold->boolean();
  if (const auto gravity = object.find("gravity")) set.gravity = gravity->boolean();
  object.finish();
  return set;
}

std::vector<std::string> read_hints(const JsonValue& list) {
  constexpr std::size_t kMost = 4;  // each takes a quarter of the points
  std::vector<std::string> hints;
  for (const JsonValue& element : list.elements()) hints.push_back(read_text(element, kText));
  if (hints.size() > kMost) throw list.error(fmt::format("has {} hints; must have at most {}", hints.size(), kMost));
  return hints;
}

Step read_step(const JsonValue& value, const anatomy::Specimen& specimen) {
  JsonObject object(value);
  Step step;
  step.title = read_text(object.at("title"), kTitle);
  step.text = read_text(object.at("text"), kText);
  if (const auto view = object.find("view")) {
    step.view = view->one_of({"lateral", "medial", "cranial", "caudal", "dorsal", "palmar"});
  }
  if (const auto show = object.find("show")) step.show = read_show(*show, specimen);
  if (const auto set = object.find("set")) step.set = read_setting(*set);
  if (const auto task = object.find("task")) step.task = read_task(*task, specimen);
  if (const auto hints = object.find("hints")) step.hints = read_hints(*hints);
  const bool only_read = std::holds_alternative<ReadTask>(step.task);
  step.points = only_read ? 0.0 : 1.0;
  if (const auto points = object.find("points")) {
    step.points = points->number_between(0.0, 100.0);
    if (only_read && step.points > 0.0) throw points->error("reading earns no points; give the step a task, or 0");
  }
  object.finish();
  return step;
}

/// Before anything else, so that a lesson of another version is refused as one and not for an unknown key.
void require_schema(JsonObject& object) {
  const JsonValue schema = object.at("schema");
  const double version = schema.number();
  if (version == kSchema) return;
  throw schema.error(fmt::format("the lesson is of version {}, this program reads version {}; {}", version, kSchema,
                                 version > kSchema
                                     ? "get a newer Myotact, or ask the author for a lesson of this version"
                                     : "write \"schema\": 1 and check the lesson again"));
}

std::string read_key(const JsonValue& value) {
  constexpr std::size_t kLongest = 60;
  std::string key = value.string();
  const bool plain = std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  if (key.empty() || key.size() > kLongest || !plain) {
    throw value.error("must be 1 to 60 small letters, digits, _ or -, for example \"my_quiz\"");
  }
  return key;
}

/// Everything but the steps, which are only counted.
LessonHead read_head(JsonObject& object, Lesson& lesson) {
  require_schema(object);
  lesson.file = object.value().file();
  lesson.key = read_key(object.at("key"));
  lesson.title = read_text(object.at("title"), kTitle);
  lesson.scene = read_text(object.at("scene"), kText);
  lesson.author = object.string_or("author", "");
  lesson.language = object.string_or("language", "en");
  if (const auto sources = object.find("sources")) lesson.sources = sources->strings();
  constexpr std::size_t kMostSteps = 200;
  const JsonValue steps = object.at("steps");
  const std::size_t count = steps.elements().size();
  if (count == 0 || count > kMostSteps) {
    throw steps.error(fmt::format("has {} steps; must have 1 to {}", count, kMostSteps));
  }
  object.finish();
  return {lesson.file, lesson.key, lesson.title, lesson.scene, lesson.language, static_cast<int>(count)};
}

nlohmann::json read_small_json(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  if (text.size() > kLongestFile_bytes) {
    throw bad_data(path.string(), "",
                   fmt::format("has {} bytes; a lesson has at most {}", text.size(), kLongestFile_bytes));
  }
  return parse_json(text, path.string());
}

Lesson read_lesson(const nlohmann::json& json, const std::string& file, const anatomy::Specimen& specimen) {
  JsonObject object{JsonValue(json, file)};
  Lesson lesson;
  read_head(object, lesson);
  for (const JsonValue& step : object.at("steps").elements()) lesson.steps.push_back(read_step(step, specimen));
  return lesson;
}

}  // namespace

Lesson parse_lesson(const std::string& text, const std::string& file, const anatomy::Specimen& specimen) {
  return read_lesson(parse_json(text, file), file, specimen);
}

Lesson load_lesson(const std::filesystem::path& path, const anatomy::Specimen& specimen) {
  return read_lesson(read_small_json(path), path.string(), specimen);
}

LessonHead load_lesson_head(const std::filesystem::path& path) {
  const nlohmann::json json = read_small_json(path);
  JsonObject object{JsonValue(json, path.string())};
  Lesson lesson;
  return read_head(object, lesson);
}

}  // namespace myotact::learn
