#pragma once

#include <span>
#include <vector>

namespace myotact::fit_texture {

/// Reflection coefficients of the auto-regressive process that the pieces are parts of (Burg 1975, sums over all
/// pieces), signs as in haptics/autoregression.h. Every one lies within (-1, 1). Pieces shorter than twice the order
/// are left out.
std::vector<double> burg_reflection(std::span<const std::vector<double>> pieces, int order);

}  // namespace myotact::fit_texture
