#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/json_reader.h"
#include "core/text.h"

namespace myotact::prepare {

/// Index of the part with that key. Throws Error BadData naming the nearest key when there is none.
template <class Part>
int index_of(const JsonValue& name, const std::vector<Part>& parts, const char* kind) {
  std::vector<std::string> keys;
  for (const Part& part : parts) keys.push_back(part.key);
  const std::string key = name.string();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] == key) return static_cast<int>(i);
  }
  throw name.error(
      fmt::format("names the {} \"{}\" that is not there; the nearest is \"{}\"", kind, key, nearest_word(key, keys)));
}

}  // namespace myotact::prepare
