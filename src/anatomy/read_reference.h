#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/json_reader.h"
#include "core/text.h"

namespace myotact::anatomy {

/// Index of the part with the key that `name` holds. Throws Error BadData that names the nearest one.
template <class Part>
int reference(const JsonValue& name, const std::vector<Part>& parts, const char* kind) {
  const std::string key = name.string();
  std::vector<std::string> keys;
  for (const Part& part : parts) keys.push_back(part.key);
  const auto found = std::find(keys.begin(), keys.end(), key);
  if (found != keys.end()) return static_cast<int>(found - keys.begin());
  throw name.error(
      fmt::format("names the {} \"{}\" that is not there; the nearest is \"{}\"", kind, key, nearest_word(key, keys)));
}

}  // namespace myotact::anatomy
