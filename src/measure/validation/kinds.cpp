#include "measure/validation/kinds.h"

#include <fmt/format.h>

#include "core/text.h"
#include "measure/validation/bar_kinds.h"
#include "measure/validation/beam_kinds.h"
#include "measure/validation/element_kinds.h"
#include "measure/validation/fibre_kinds.h"
#include "measure/validation/homogeneous_kind.h"
#include "measure/validation/line_kinds.h"
#include "measure/validation/motion_kinds.h"
#include "measure/validation/muscle_kinds.h"
#include "measure/validation/oscillator_kinds.h"
#include "measure/validation/pair_kinds.h"
#include "measure/validation/pendulum_kind.h"

namespace myotact::measure {

const std::vector<Kind>& validation_kinds() {
  static const std::vector<Kind> kinds = {
      {"activation", activation},
      {"antagonist_pair", antagonist_pair},
      {"beam_vibration", beam_vibration},
      {"cantilever", cantilever},
      {"clamped_bar", clamped_bar},
      {"co_contraction_factors", co_contraction_factors},
      {"force_curves", force_curve_values},
      {"hanging_beam", hanging_beam},
      {"hinge_pendulum", hinge_pendulum},
      {"homogeneous_state", homogeneous_state},
      {"isotonic_velocity", isotonic_velocity},
      {"line_stiffness", line_stiffness_table},
      {"muscle_elements", muscle_elements},
      {"oscillator", oscillator},
      {"oscillator_order", oscillator_order},
      {"pair_oscillation", pair_oscillation},
      {"patch_test", patch_test},
      {"pulse_response", pulse_response},
      {"short_range_pair", short_range_pair},
      {"solid_conservation", solid_conservation},
      {"solid_order", solid_order},
      {"tangent_test", tangent_test},
      {"thick_cylinder", thick_cylinder},
  };
  return kinds;
}

std::string quantity_at(std::string_view name, double place) {
  return fmt::format("{}({})", name, to_text(place));
}

}  // namespace myotact::measure
