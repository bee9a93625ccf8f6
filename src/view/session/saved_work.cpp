#include "view/session/saved_work.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "core/user_folder.h"

namespace myotact::view {

namespace {

constexpr int kSchema = 1;
constexpr const char* kFolder = "works";
const std::vector<std::string> kDrives = {"script", "levels", "balance"};  // as in Drive
/// Of a hand's tool: as the scene says, or as in ToolShape.
const std::vector<std::string> kTools = {"scene", "ball", "point", "clamp"};
const std::vector<std::string> kTissues = {"", "fem", "mass_spring", "line", "rigid"};

nlohmann::json json_of(const SceneState& state) {
  // All members by name: a new one does not compile until it is saved.
  const auto& [drive, flexors, extensors, common, difference, hold_posture, gravity, tools] = state;
  nlohmann::json tool_names = nlohmann::json::array();
  for (const auto& tool : tools) tool_names.push_back(kTools.at(tool ? 1 + static_cast<std::size_t>(*tool) : 0));
  return {{"drive", kDrives.at(static_cast<std::size_t>(drive))},
          {"flexors", flexors},
          {"extensors", extensors},
          {"common", common},
          {"difference", difference},
          {"hold_posture", hold_posture},
          {"gravity", gravity},
          {"tools", tool_names}};
}

/// In the scene's order; those that the file does not name are as the scene says.
messages::ChosenTools parse_tools(const JsonValue& json) {
  messages::ChosenTools tools{};
  std::size_t next = 0;
  for (const JsonValue& name : json.elements()) {
    if (next == tools.size()) throw name.error("is one more than a person has hands; name two at most");
    const auto at = std::find(kTools.begin(), kTools.end(), name.one_of(kTools)) - kTools.begin();
    if (at > 0) tools.at(next) = static_cast<messages::ToolShape>(at - 1);
    ++next;
  }
  return tools;
}

SceneState parse_state(const JsonValue& json) {
  JsonObject object(json);
  SceneState state;
  const std::string drive = object.at("drive").one_of(kDrives);
  state.drive = static_cast<Drive>(std::find(kDrives.begin(), kDrives.end(), drive) - kDrives.begin());
  const auto level = [&](const char* key, double lowest) {
    const auto value = object.find(key);
    return value ? value->number_between(lowest, 1.0) : 0.0;
  };
  state.flexors = level("flexors", 0.0);
  state.extensors = level("extensors", 0.0);
  state.common = level("common", 0.0);
  state.difference = level("difference", -1.0);
  state.hold_posture = object.boolean_or("hold_posture", state.hold_posture);
  state.gravity = object.boolean_or("gravity", state.gravity);
  if (const auto tools = object.find("tools")) state.tools = parse_tools(*tools);
  object.finish();
  return state;
}

constexpr std::array<const char*, 2> kKept = {"a", "b"};

nlohmann::json json_of(const KeptStates& kept) {
  nlohmann::json states = nlohmann::json::object();
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) states[kKept[i]] = json_of(*kept[i]);
  }
  return states;
}

KeptStates parse_kept(const JsonValue& json) {
  JsonObject object(json);
  KeptStates kept;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (const auto state = object.find(kKept[i])) kept[i] = parse_state(*state);
  }
  object.finish();
  return kept;
}

/// A name as a person writes it, as the beginning of a file's.
std::string file_name_of(const std::string& name) {
  constexpr std::size_t kLongest =
      40;  // characters of at most 4 bytes: with the time below the 255 bytes of a file name
  std::string safe = name.substr(0, bytes_of_characters(name, kLongest));
  for (char& c : safe) {
    if (static_cast<unsigned char>(c) <= ' ' || c == '/' || c == '\\' || c == '\x7f') c = '_';
  }
  if (safe.starts_with('.')) safe.front() = '_';
  return safe;
}

bool is_time(std::string_view text) {
  constexpr std::string_view kPattern = "0000-00-00_00.00.00";
  return text.size() == kPattern.size() && std::equal(text.begin(), text.end(), kPattern.begin(), [](char c, char p) {
           return p == '0' ? std::isdigit(static_cast<unsigned char>(c)) != 0 : c == p;
         });
}

/// What new_user_path() made of name and time.
ListedWork listed(const std::filesystem::path& file) {
  constexpr std::size_t kTime = 19;  // bytes of a time
  const std::string stem = file.stem().string();
  for (std::size_t at = stem.rfind('_'); at != std::string::npos && at > 0; at = stem.rfind('_', at - 1)) {
    const std::string time = stem.substr(at + 1, kTime);
    if (!is_time(time)) continue;
    return {file, stem.substr(0, at), time.substr(0, 10) + " " + time.substr(11, 2) + ":" + time.substr(14, 2)};
  }
  return {file, stem, ""};
}

}  // namespace

SavedWork parse_work(const std::string& text, const std::string& file) {
  const nlohmann::json json = parse_json(text, file);
  JsonObject object{JsonValue(json, file)};
  require_schema(object);
  SavedWork work;
  const JsonValue scene = object.at("scene");
  work.scene = scene.string();
  if (work.scene.empty()) throw scene.error("is empty; name a scene, as \"elbow\", or the path of a scene file");
  if (const auto tissue = object.find("tissue")) work.tissue = tissue->one_of(kTissues);
  work.specimen = object.string_or("specimen", "");
  work.view = parse_view(object.at("view"));
  work.state = parse_state(object.at("settings"));
  if (const auto kept = object.find("kept")) work.kept = parse_kept(*kept);
  work.marks = parse_marks(object);
  object.finish();
  return work;
}

SavedWork read_work(const std::filesystem::path& file, const std::vector<std::string>& scenes) {
  SavedWork work = parse_work(read_file(file), file.string());
  std::error_code unknown;
  if (std::find(scenes.begin(), scenes.end(), work.scene) != scenes.end()) return work;
  if (std::filesystem::is_regular_file(work.scene, unknown)) return work;
  throw bad_data(file.string(), "/scene",
                 fmt::format("there is no scene \"{}\"; put its file there again, or name one of {} (nearest: \"{}\")",
                             work.scene, join(scenes), nearest_word(work.scene, scenes)));
}

std::string work_text(const SavedWork& work) {
  nlohmann::json json = {{"schema", kSchema},         {"scene", work.scene},        {"tissue", work.tissue},
                         {"specimen", work.specimen}, {"view", json_of(work.view)}, {"settings", json_of(work.state)}};
  if (work.kept != KeptStates{})
    json["kept"] = json_of(work.kept);  // works without it were written before it was known
  put_marks(work.marks, json);
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::filesystem::path save_work(const SavedWork& work, const std::string& name) {
  const std::string stem = file_name_of(name.empty() ? std::filesystem::path(work.scene).stem().string() : name);
  const std::filesystem::path file = new_user_path(kFolder, stem, ".json");
  write_file(file, work_text(work));
  return file;
}

std::filesystem::path works_folder() {
  const std::filesystem::path own = user_data_folder();
  return own.empty() ? own : own / kFolder;
}

std::vector<ListedWork> list_works() {
  std::vector<std::pair<std::filesystem::file_time_type, std::filesystem::path>> files;
  std::error_code refused;
  for (const auto& entry : std::filesystem::directory_iterator(works_folder(), refused)) {
    std::error_code gone;
    const auto written = entry.last_write_time(gone);
    if (!gone && entry.path().extension() == ".json") files.emplace_back(written, entry.path());
  }
  std::sort(files.rbegin(), files.rend());
  std::vector<ListedWork> works;
  for (const auto& [written, file] : files) works.push_back(listed(file));
  return works;
}

}  // namespace myotact::view
