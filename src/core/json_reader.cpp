#include "core/json_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "core/text.h"

namespace myotact {

namespace {

/// JSON pointer token: "~" and "/" are escaped (RFC 6901).
std::string pointer_token(const std::string& key) {
  std::string token;
  for (const char c : key) token += c == '~' ? std::string("~0") : c == '/' ? std::string("~1") : std::string(1, c);
  return token;
}

std::string line_and_column(const std::string& text, std::size_t byte) {
  const std::size_t end = std::min(byte == 0 ? 0 : byte - 1, text.size());
  const auto start = text.begin();
  const auto here = start + static_cast<std::ptrdiff_t>(end);
  const auto line = std::count(start, here, '\n') + 1;
  const std::size_t newline = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  const std::size_t column = newline == std::string::npos ? end + 1 : end - newline;
  return fmt::format("{}:{}", line, column);
}

/// A value as it appears in a message: short whatever the file holds, and never by recursion into nested lists.
std::string shown(const nlohmann::json& value) {
  if (value.is_array()) return "a list";
  if (value.is_object()) return "an object";
  constexpr std::size_t kLongestShown = 60;
  const std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return text.size() <= kLongestShown ? text : text.substr(0, kLongestShown) + "...";
}

/// Where the number that does not fit a double stands; nlohmann quotes it but does not say where.
std::string place_of_number(const std::string& text, const std::string& message) {
  const std::size_t opening = message.find('\'');
  const std::size_t closing = message.rfind('\'');
  if (opening == std::string::npos || closing <= opening + 1) return "";
  const std::size_t byte = text.find(message.substr(opening + 1, closing - opening - 1));
  return byte == std::string::npos ? "" : line_and_column(text, byte + 1);
}

/// What nlohmann's message says after its own position, which is already named.
std::string reason(const std::string& message) {
  const std::size_t position = message.find(": ", message.find("column"));
  return position == std::string::npos ? message : message.substr(position + 2);
}

/// Whether the word at a place of the text is one of those that programs write for what is not a number.
bool is_no_number(const std::string& text, std::size_t byte) {
  const auto in_word = [&](std::size_t place) {
    return place < text.size() && std::isalpha(static_cast<unsigned char>(text[place])) != 0;
  };
  std::size_t start = byte == 0 ? 0 : byte - 1;
  while (start > 0 && in_word(start - 1)) --start;
  std::string word;
  for (std::size_t place = start; in_word(place) && word.size() < 9; ++place) {
    word += static_cast<char>(std::tolower(static_cast<unsigned char>(text[place])));
  }
  return word == "nan" || word == "inf" || word == "infinity";
}

}  // namespace

nlohmann::json parse_json(const std::string& text, const std::string& file) {
  // Deeper values would overflow the stack where they are written out again, which the library does by recursion.
  constexpr int kDeepestNesting = 64;  // eight times the deepest value of our formats
  const auto refuse_depth = [&](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
    if (depth > kDeepestNesting) {
      throw bad_data(file, "", fmt::format("nests lists or objects deeper than {}; flatten them", kDeepestNesting));
    }
    return true;
  };
  try {
    return nlohmann::json::parse(text, refuse_depth, true, true);
  } catch (const nlohmann::json::parse_error& failure) {
    if (is_no_number(text, failure.byte)) {
      throw bad_data(file, line_and_column(text, failure.byte), "NaN and infinity are no numbers; write a finite one");
    }
    throw bad_data(file, line_and_column(text, failure.byte), reason(failure.what()));
  } catch (const nlohmann::json::exception& failure) {  // a number beyond the range of a double
    throw bad_data(file, place_of_number(text, failure.what()), "holds a number beyond 1.8e308; write a smaller one");
  }
}

nlohmann::json read_json(const std::filesystem::path& path) {
  return parse_json(read_file(path), path.string());
}

double JsonValue::number() const {
  if (!value_->is_number()) throw error(fmt::format("is {}; must be a number", shown(*value_)));
  return value_->get<double>();
}

double JsonValue::number_between(double lowest, double highest) const {
  const double value = number();
  if (!(value >= lowest && value <= highest)) {
    throw error(fmt::format("is {}; must be between {} and {}", to_text(value), to_text(lowest), to_text(highest)));
  }
  return value;
}

int JsonValue::integer_between(int lowest, int highest) const {
  const double value = number_between(lowest, highest);
  if (value != std::floor(value)) throw error(fmt::format("is {}; must be a whole number", to_text(value)));
  return static_cast<int>(value);
}

bool JsonValue::boolean() const {
  if (!value_->is_boolean()) throw error(fmt::format("is {}; must be true or false", shown(*value_)));
  return value_->get<bool>();
}

std::string JsonValue::string() const {
  if (!value_->is_string()) throw error(fmt::format("is {}; must be a text in quotes", shown(*value_)));
  return value_->get<std::string>();
}

std::string JsonValue::one_of(const std::vector<std::string>& allowed) const {
  std::string word = string();
  if (std::find(allowed.begin(), allowed.end(), word) == allowed.end()) {
    throw error(fmt::format("is {}; must be one of {} (nearest: \"{}\")", shown(*value_), join(allowed),
                            nearest_word(word, allowed)));
  }
  return word;
}

Vec3 JsonValue::vec3() const {
  const auto parts = elements(3);
  return {parts[0].number(), parts[1].number(), parts[2].number()};
}

std::vector<JsonValue> JsonValue::elements() const {
  if (!value_->is_array()) throw error(fmt::format("is {}; must be a list", shown(*value_)));
  std::vector<JsonValue> parts;
  for (std::size_t i = 0; i < value_->size(); ++i) {
    parts.emplace_back((*value_)[i], file_, fmt::format("{}/{}", pointer_, i));
  }
  return parts;
}

std::vector<JsonValue> JsonValue::elements(std::size_t count) const {
  if (!value_->is_array()) throw error(fmt::format("is {}; must be a list of {}", shown(*value_), count));
  auto parts = elements();
  if (parts.size() != count) throw error(fmt::format("has {} elements; must have {}", parts.size(), count));
  return parts;
}

std::vector<std::string> JsonValue::strings() const {
  std::vector<std::string> words;
  for (const JsonValue& part : elements()) words.push_back(part.string());
  return words;
}

JsonObject::JsonObject(const JsonValue& value) : value_(value) {
  if (!value.raw().is_object())
    throw value.error(fmt::format("is {}; must be an object in braces", shown(value.raw())));
}

std::optional<JsonValue> JsonObject::find(const std::string& key) {
  asked_.insert(key);
  const auto found = value_.raw().find(key);
  if (found == value_.raw().end()) return std::nullopt;
  return JsonValue(*found, value_.file(), value_.pointer() + "/" + pointer_token(key));
}

JsonValue JsonObject::at(const std::string& key) {
  auto found = find(key);
  if (!found) throw value_.error(fmt::format("the key \"{}\" is missing", key));
  return *found;
}

double JsonObject::number_or(const std::string& key, double fallback) {
  const auto found = find(key);
  return found ? found->number() : fallback;
}

std::string JsonObject::string_or(const std::string& key, const std::string& fallback) {
  const auto found = find(key);
  return found ? found->string() : fallback;
}

bool JsonObject::boolean_or(const std::string& key, bool fallback) {
  const auto found = find(key);
  return found ? found->boolean() : fallback;
}

std::vector<std::pair<std::string, JsonValue>> JsonObject::entries() {
  std::vector<std::pair<std::string, JsonValue>> all;
  for (const auto& item : value_.raw().items()) all.emplace_back(item.key(), at(item.key()));
  return all;
}

void JsonObject::finish() const {
  const std::vector<std::string> known(asked_.begin(), asked_.end());
  for (const auto& item : value_.raw().items()) {
    if (asked_.contains(item.key())) continue;
    throw JsonValue(item.value(), value_.file(), value_.pointer() + "/" + pointer_token(item.key()))
        .error(fmt::format("unknown key; the nearest known one is \"{}\"", nearest_word(item.key(), known)));
  }
}

}  // namespace myotact
