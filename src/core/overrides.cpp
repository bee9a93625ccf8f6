#include "core/overrides.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/json_places.h"
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

bool is_called(const nlohmann::json& element, std::string_view word) {
  constexpr std::array kNames = {"key", "name", "muscle"};
  return element.is_object() && std::any_of(kNames.begin(), kNames.end(), [&](const char* name) {
           const auto found = element.find(name);
           return found != element.end() && found->is_string() && found->get_ref<const std::string&>() == word;
         });
}

std::vector<nlohmann::json*> children_called(std::string_view word, nlohmann::json& holder) {
  std::vector<nlohmann::json*> found;
  if (holder.is_object() && word != "*") {
    const auto entry = holder.find(std::string(word));
    if (entry != holder.end()) found.push_back(&*entry);
  } else if (holder.is_object() || holder.is_array()) {
    std::size_t place = 0;
    for (nlohmann::json& element : holder) {
      if (word == "*" || word == std::to_string(place++) || is_called(element, word)) found.push_back(&element);
    }
  }
  return found;
}

/// The place that `tissue.default` means; what is missing on the way is made, but in lists.
nlohmann::json& place_of(std::string_view dotted, nlohmann::json& json) {
  nlohmann::json* place = &json;
  while (true) {
    const std::size_t point = dotted.find('.');
    const std::string word(dotted.substr(0, point));
    if (!place->is_array() && !place->is_object()) *place = nlohmann::json::object();
    const auto known = place->is_array() ? children_called(word, *place) : std::vector<nlohmann::json*>{};
    if (place->is_array() && known.empty()) *place = nlohmann::json::object();  // whose reader says what it wants
    place = known.empty() ? &(*place)[word] : known.front();
    if (point == std::string_view::npos) return *place;
    dotted.remove_prefix(point + 1);
  }
}

}  // namespace

void override_values(nlohmann::json& json, const Overrides& overrides) {
  for (const auto& [key, value] : overrides) {
    const auto places = places_of(key, json);
    if (places.empty()) {
      place_of(key, json) = value_of(value);
    } else {
      for (nlohmann::json* place : places) *place = value_of(value);
    }
  }
}

std::vector<nlohmann::json*> places_of(std::string_view dotted, nlohmann::json& json) {
  for (std::size_t end = dotted.find('.'); end != std::string_view::npos; end = dotted.find('.', end + 1)) {
    std::vector<nlohmann::json*> found;
    for (nlohmann::json* child : children_called(dotted.substr(0, end), json)) {
      const auto below = places_of(dotted.substr(end + 1), *child);
      found.insert(found.end(), below.begin(), below.end());
    }
    if (!found.empty()) return found;
  }
  return children_called(dotted, json);
}

}  // namespace myotact
