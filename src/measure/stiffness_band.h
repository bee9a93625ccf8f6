#pragma once

#include <span>
#include <string>
#include <vector>

#include "measure/line_limb.h"
#include "measure/stiffness_row.h"

namespace myotact::measure {

/// How uncertain the peak forces of one side are against the other's, of 1. An estimate like the forces themselves,
/// which are areas of greyhounds times one tension for all.
inline constexpr double kPeakForceUncertainty = 0.2;
/// How uncertain the fibres' length at the file pose is, over the optimal one. An estimate: it was not measured on this
/// limb, and 0.8 lies near the short end of the lengths at which muscles work.
inline constexpr double kRestStretchUncertainty = 0.1;

/// How far K may lie from what is computed, because the anatomy is not known better: of the muscle lines, which are
/// cheap. One measure at a time is put to both ends of its uncertainty (the joint's centre and its axis along two
/// directions across the axis each, peak force of the flexors against the extensors', rest stretch of all), the balance
/// is solved anew, and the changes add up as the root of the sum of their squares, upwards and downwards apart.
/// Causes whose uncertainty the specimen gives as 0 are left out. `angles_rad`: one a joint.
std::vector<BandPart> stiffness_band(const LineLimb& limb, std::span<const double> angles_rad, double common);

/// Root of the sum of squares of all parts, both ways.
BandPart whole_band(const std::vector<BandPart>& parts);

/// What the specimen gives no uncertainty for, as a sentence to show; empty when nothing is missing.
std::string missing_uncertainty(const anatomy::Joint& joint);

}  // namespace myotact::measure
