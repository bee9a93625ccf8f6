#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

/// A bar of muscle along x whose end faces are clamped and moved apart, then made active. Inputs: size_m, cells,
/// element, laws, activation, stretches. Quantities by stretch: force_N, of the support at the moved end along x (what
/// holds a muscle that pulls is positive).
Quantities clamped_bar(JsonObject& inputs);

/// A quarter of a thick tube under inner pressure in plane strain. Inputs: inner_m, outer_m, length_m, cells (across
/// the wall, around, along), element, laws (the first neo_hookean, nearly incompressible), pressures_Pa. Quantities by
/// pressure: radius_ratio, mean inner radius now over at rest; pressure_ratio, of the pressure that the incompressible
/// closed form needs for this radius to the one that acts.
Quantities thick_cylinder(JsonObject& inputs);

}  // namespace myotact::measure
