#include "core/overrides.h"

#include <string_view>

#include <nlohmann/json.hpp>

#include "core/json_reader.h"

namespace myotact {

namespace {

nlohmann::json value_of(const std::string& value) {
  try {
    return parse_json(value, "");
  } catch (const Error&) {
    return value;
  }
}

/// The place that `tissue.default` means; what is missing on the way is made.
nlohmann::json& place_of(std::string_view dotted, nlohmann::json& json) {
  nlohmann::json* place = &json;
  for (std::size_t point = dotted.find('.'); point != std::string_view::npos; point = dotted.find('.')) {
    place = &(*place)[std::string(dotted.substr(0, point))];
    if (!place->is_object()) *place = nlohmann::json::object();
    dotted.remove_prefix(point + 1);
  }
  return (*place)[std::string(dotted)];
}

}  // namespace

void override_values(nlohmann::json& json, const Overrides& overrides) {
  for (const auto& [key, value] : overrides) place_of(key, json) = value_of(value);
}

}  // namespace myotact
