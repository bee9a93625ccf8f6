#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/error.h"
#include "core/vector.h"

namespace myotact {

/// Reads a JSON file that may hold // comments. Throws Error: NoInput, or BadData naming line:column. Values nested
/// deeper than 64 are refused, so that what it returns may be walked and written by recursion.
nlohmann::json read_json(const std::filesystem::path& path);
/// The same from text; `file` is only named in errors.
nlohmann::json parse_json(const std::string& text, const std::string& file);

/// One value of a JSON file together with its place, so that every error can name file and JSON pointer.
/// All functions throw Error BadData when the value has the wrong type or lies outside the allowed range.
class JsonValue {
 public:
  JsonValue(const nlohmann::json& value, std::string file, std::string pointer = "")
      : value_(&value), file_(std::move(file)), pointer_(std::move(pointer)) {}

  double number() const;
  double number_between(double lowest, double highest) const;
  int integer_between(int lowest, int highest) const;
  bool boolean() const;
  std::string string() const;
  /// A string that is one of `allowed`; the error names the nearest one.
  std::string one_of(const std::vector<std::string>& allowed) const;
  Vec3 vec3() const;
  std::vector<JsonValue> elements() const;
  /// As elements(), with exactly `count` of them.
  std::vector<JsonValue> elements(std::size_t count) const;
  std::vector<std::string> strings() const;

  const nlohmann::json& raw() const { return *value_; }
  const std::string& file() const { return file_; }
  const std::string& pointer() const { return pointer_; }
  Error error(const std::string& problem) const { return bad_data(file_, pointer_.empty() ? "/" : pointer_, problem); }

 private:
  const nlohmann::json* value_;
  std::string file_;
  std::string pointer_;
};

/// A JSON object whose every key must be asked for: finish() refuses the rest and names the nearest known key.
class JsonObject {
 public:
  explicit JsonObject(const JsonValue& value);

  JsonValue at(const std::string& key);                   // throws when missing
  std::optional<JsonValue> find(const std::string& key);  // nothing when missing
  double number_or(const std::string& key, double fallback);
  std::string string_or(const std::string& key, const std::string& fallback);
  bool boolean_or(const std::string& key, bool fallback);
  /// All keys with their values, for objects that map names to things.
  std::vector<std::pair<std::string, JsonValue>> entries();
  void finish() const;
  const JsonValue& value() const { return value_; }

 private:
  JsonValue value_;
  std::set<std::string> asked_;
};

}  // namespace myotact
