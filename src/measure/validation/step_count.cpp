#include "measure/validation/step_count.h"

#include <cmath>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::measure {

int step_count(const JsonValue& time_s, double dt_s) {
  constexpr double kMostSteps = 1e7;
  constexpr double kRounding = 1e-6;  // of a step: decimal fractions are not exact
  const double steps = time_s.number_between(dt_s, kMostSteps * dt_s) / dt_s;
  if (std::abs(steps - std::round(steps)) > kRounding) {
    throw time_s.error(
        fmt::format("is {} s; must be a whole multiple of dt_s = {}", to_text(time_s.number()), to_text(dt_s)));
  }
  return static_cast<int>(std::lround(steps));
}

}  // namespace myotact::measure
