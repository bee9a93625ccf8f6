#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "anatomy/specimen.h"

// What a specimen and the recipe of one write alike: the counterparts of read_body.h.

namespace myotact::anatomy {

using Json = nlohmann::ordered_json;  // keys stay in the order of the format's page

Json json_of(const Vec3& v);
Json json_of(const Body& body);
/// Parent and child by their keys in `bodies`.
Json json_of(const Joint& joint, const std::vector<Body>& bodies);
/// Forces, lengths and times of a muscle, and where they come from.
Json json_of_mechanics(const Muscle& muscle);

}  // namespace myotact::anatomy
