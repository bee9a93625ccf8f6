#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

/// A shaken box whose surface is moved by an affine map. Inputs: size_m, cells, shake (of a cell, inner nodes),
/// element, laws, gradient (3 x 3, rows). Quantities: tets; interior_error, the largest distance of a node from where
/// the map puts it, over the box's largest size; stress_spread, the largest difference between two tets' stress, over
/// it.
Quantities patch_test(JsonObject& inputs);

/// A shaken box, all nodes displaced at random. Inputs: size_m, cells, shake, element, laws, fibre (along x),
/// activation (0), displacement_m (deviation of each component). Quantities: slope, of |f(x + e d) - f(x) - e K d|
/// against e, and slope_of_energy, of the same for |W(x + e d) - W(x) - e f.d|, in the logarithm, the farthest from 2
/// between any two neighbours of e = 1e-2 .. 1e-4; asymmetry of K, over it, from its columns' products with two random
/// directions by differences of the forces; stored_asymmetry, of K's diagonal blocks (the others are stored once).
Quantities tangent_test(JsonObject& inputs);

}  // namespace myotact::measure
