#pragma once

#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace myotact {

/// The values that a dotted key means: "a.b" is b of the object a. A word means an element of a list by its place from
/// 0
/// ("script.2.depth_m") or by its "key", "name" or "muscle" ("muscles.brachialis.peak_force_N"), and "*" means all.
/// Keys may hold points themselves. Empty where there is none. Valid until `json` changes.
std::vector<nlohmann::json*> places_of(std::string_view dotted, nlohmann::json& json);

}  // namespace myotact
