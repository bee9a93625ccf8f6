#pragma once

#include <string>

#include "measure/fidelity/touch_map.h"

namespace myotact::measure {

/// How the places of one muscle came out.
struct MuscleTouch {
  int muscle = -1;
  int good = 0, fair = 0, poor = 0, unknown = 0;
  double median_error_share = 0.0, worst_error_share = 0.0;  // of those where something was felt; NaN: nowhere
  double worst_swing_N = 0.0;
};
/// One a muscle, in the specimen's order, those without a place included.
std::vector<MuscleTouch> by_muscle(const TouchMap& map);

/// "good at 57 of 62 places (92 %), fair at 4, poor at 1, nothing felt at 0".
std::string verdict_text(const TouchMap& map);

std::string touch_map_text(const TouchMap& map);  // a row a muscle
std::string touch_map_json(const TouchMap& map);
std::string touch_map_csv(const TouchMap& map);  // a row a place

}  // namespace myotact::measure
