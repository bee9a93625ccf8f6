#include "device/drivers/inverse/messages.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace myotact::device::inverse {

namespace {

using Json = nlohmann::json;

/// Beyond the arm's reach (0.15 m about the middle) by far: numbers of another unit or none at all.
constexpr double kFarthest_m = 2.0;
constexpr double kFastest_m_s = 50.0;

/// Found while reading, caught by read_message; nothing of it leaves this file.
struct Broken {
  std::string problem;
};

const Json* member(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

const Json* object_member(const Json& object, const char* key) {
  const Json* const value = member(object, key);
  if (value != nullptr && !value->is_object()) throw Broken{fmt::format("\"{}\" is no object", key)};
  return value;
}

std::string id_of(const Json& entry) {
  const Json* const id = member(entry, "device_id");
  if (id == nullptr || !id->is_string()) throw Broken{"an entry has no \"device_id\" of text"};
  const auto& text = id->get_ref<const std::string&>();
  const auto is_plain = [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-' || c == ':' || c == '.');
  };
  if (text.empty() || text.size() > kLongestId || !std::all_of(text.begin(), text.end(), is_plain)) {
    throw Broken{fmt::format("a \"device_id\" is not 1 to {} letters, digits or _-:.", kLongestId)};
  }
  return text;
}

std::array<std::optional<double>, 3> axes_of(const Json& state, const char* key, double farthest) {
  std::array<std::optional<double>, 3> axes;
  const Json* const object = object_member(state, key);
  if (object == nullptr) return axes;
  constexpr std::array kNames = {"x", "y", "z"};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Json* const number = member(*object, kNames[i]);
    if (number == nullptr) continue;
    if (!number->is_number()) throw Broken{fmt::format("\"{}/{}\" is not a number", key, kNames[i])};
    const double value = number->get<double>();
    if (!(std::abs(value) <= farthest)) {
      throw Broken{fmt::format("\"{}/{}\" is {}; must be in -{} .. {}", key, kNames[i], value, farthest, farthest)};
    }
    axes[i] = value;
  }
  return axes;
}

DeviceEntry device_of(const Json& entry) {
  DeviceEntry device;
  device.id = id_of(entry);
  const Json* const state = object_member(entry, "state");
  if (state == nullptr) return device;
  device.position_service_m = axes_of(*state, "cursor_position", kFarthest_m);
  const auto velocity = axes_of(*state, "cursor_velocity", kFastest_m_s);
  device.velocity_service_m_s = Vec3(velocity[0].value_or(0.0), velocity[1].value_or(0.0), velocity[2].value_or(0.0));
  return device;
}

GripEntry grip_of(const Json& entry) {
  GripEntry grip;
  grip.id = id_of(entry);
  const Json* const state = object_member(entry, "state");
  const Json* const buttons = state == nullptr ? nullptr : object_member(*state, "buttons");
  if (buttons == nullptr) return grip;
  struct Name {
    const char* name;
    unsigned bit;
  };
  constexpr std::array kNames = {Name{"a", 0},        Name{"b", 1},        Name{"c", 2},       Name{"button_0", 0},
                                 Name{"button_1", 1}, Name{"button_2", 2}, Name{"button_3", 3}};
  for (const Name& name : kNames) {
    const Json* const down = member(*buttons, name.name);
    if (down == nullptr) continue;
    if (!down->is_boolean()) throw Broken{fmt::format("\"buttons/{}\" is neither true nor false", name.name)};
    if (down->get<bool>()) grip.buttons |= 1u << name.bit;
  }
  return grip;
}

template <class Entry>
void read_list(const Json& message, const char* key, Entry (*read)(const Json&), std::vector<Entry>& entries) {
  const Json* const list = member(message, key);
  if (list == nullptr) return;
  if (!list->is_array()) throw Broken{fmt::format("\"{}\" is no list", key)};
  if (list->size() > kMostDevices) {
    throw Broken{fmt::format("\"{}\" has {} entries; must be at most {}", key, list->size(), kMostDevices)};
  }
  for (const Json& entry : *list) {
    if (!entry.is_object()) throw Broken{fmt::format("an entry of \"{}\" is no object", key)};
    entries.push_back(read(entry));
  }
}

}  // namespace

std::string read_message(std::string_view text, ServiceMessage& message) {
  if (text.size() > kLongestMessage) {
    return fmt::format("the message has {} bytes; must be at most {}", text.size(), kLongestMessage);
  }
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return "the message is no JSON object";
  message.devices.clear();
  message.grips.clear();
  message.version.clear();
  try {
    read_list(json, "inverse3", device_of, message.devices);
    read_list(json, "wireless_verse_grip", grip_of, message.grips);
    read_list(json, "verse_grip", grip_of, message.grips);
  } catch (const Broken& broken) {
    return broken.problem;
  }
  const Json* const version = member(json, "version");
  if (version != nullptr && version->is_string()) message.version = version->get<std::string>();
  return "";
}

std::optional<ServiceVersion> read_version(std::string_view text) {
  constexpr std::size_t kLongestText = 1024;  // an answer of another program that happens to listen there
  if (text.size() > kLongestText) return std::nullopt;
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_object()) {
    const Json* const version = member(json, "version");
    return version != nullptr && version->is_string() ? read_version(version->get_ref<const std::string&>())
                                                      : std::nullopt;
  }
  const std::string word = json.is_string() ? json.get<std::string>() : std::string(text);
  const std::size_t start = word.starts_with('v') ? 1 : 0;
  const char* const end = word.data() + word.size();
  ServiceVersion version;
  const auto major = std::from_chars(word.data() + start, end, version.major);
  if (major.ec != std::errc() || major.ptr == end || *major.ptr != '.') return std::nullopt;
  const auto minor = std::from_chars(major.ptr + 1, end, version.minor);
  if (minor.ec != std::errc() || version.major < 0 || version.minor < 0) return std::nullopt;
  return version;
}

CommandForm form_for(const std::optional<ServiceVersion>& version) {
  const bool is_old = version && (version->major < 3 || (version->major == 3 && version->minor < 5));
  return is_old ? CommandForm::Values : CommandForm::Vector;
}

void write_force_command(const std::string& id, const Vec3& force_service_N, CommandForm form, std::string& text) {
  text.clear();
  fmt::format_to(std::back_inserter(text),
                 R"({{"inverse3":[{{"device_id":"{}","commands":{{"set_cursor_force":{{"{}":)"
                 R"({{"x":{:.5f},"y":{:.5f},"z":{:.5f}}}}}}}}}]}})",
                 id, form == CommandForm::Values ? "values" : "vector", force_service_N.x(), force_service_N.y(),
                 force_service_N.z());
}

}  // namespace myotact::device::inverse
