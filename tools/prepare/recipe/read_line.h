#pragma once

#include <vector>

#include "core/json_reader.h"
#include "prepare/recipe/anatomy_data.h"

// What a recipe states about a muscle's line (assets/canine/README.md lists the keys). All throw Error BadData naming
// file and JSON pointer.

namespace myotact::prepare {

CrossingData read_crossing(const JsonValue& value, const AnatomyData& data);
/// A cylinder takes the joint's own centre and axis, and any wrap the body before the joint, where none are given.
WrapData read_wrap(const JsonValue& value, const AnatomyData& data);
/// Points from origin to insertion.
std::vector<anatomy::LinePoint> read_line(const JsonValue& value, const AnatomyData& data);

}  // namespace myotact::prepare
