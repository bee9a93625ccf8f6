#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace myotact {

/// What the command line overrides in a JSON file: keys and values of --set, e.g. "dt_s", "tissue.default".
using Overrides = std::map<std::string, std::string>;

/// key=value becomes a key of `json`, an object; a.b=value one of the object a, which is made where it is missing. A
/// value that is no JSON is taken as a text.
void override_values(nlohmann::json& json, const Overrides& overrides);

}  // namespace myotact
