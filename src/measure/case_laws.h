#pragma once

#include <vector>

#include "core/json_reader.h"
#include "simulation/solid/law.h"

// The laws of solids by the names and keys that files give them (assets/cases/README.md lists them).

namespace myotact::measure {

/// A stiffness or stress beyond diamond's thousandfold is a slip of units.
inline constexpr double kLargest_Pa = 1e15;

/// The law of that name, made of its numbers, which it takes out of `parameters`. Throws Error BadData for an unknown
/// name and for a number outside its range.
simulation::Law read_law(const JsonValue& name, JsonObject& parameters);

/// Small-strain moduli of an isotropic solid.
struct LameModuli {
  double shear_Pa = 0.0, lambda_Pa = 0.0;
};
LameModuli lame_moduli(double young_Pa, double poisson);

/// Whether the law acts along the fibre, so that a tet needs one.
bool follows_fibre(const simulation::Law& law);
/// Whether the law resists shear across the fibre too, as every tet must.
bool carries_shear(const simulation::Law& law);
/// Shear modulus at rest, the smaller one of a law that is stiffer one way; 0 of fibres.
double shear_at_rest_Pa(const simulation::Law& law);

/// c of 1/2 c (J - mean J)^2 for a material that names none: the volume term's own stiffness at rest, so that a
/// compressible law stays as it is, but at most four times the shear modulus, so that a nearly incompressible one does
/// not lock (40 kPa for muscle of 10 kPa).
double default_fluctuation_Pa(const std::vector<simulation::Law>& laws);

}  // namespace myotact::measure
