#pragma once

#include <vector>

#include "prepare/partition/interfaces.h"
#include "prepare/partition/near_places.h"

namespace myotact::prepare {

/// Volumes [m3] and surface areas [m2] of labels 1 to `parts`.
std::vector<double> enclosed_volumes_m3(const Interfaces& interfaces, std::size_t parts);
std::vector<double> areas_m2(const Interfaces& interfaces, std::size_t parts);

/// Fewer triangles cut rounded bodies short: each part is moved out along its normals, all over where it borders on no
/// other part, until it has its volume, but no farther than `most_m`. Borders between parts and what is near the places
/// of `kept` stay.
void give_back_volumes(const std::vector<double>& volumes_m3, double most_m, const NearPlaces& kept,
                       Interfaces& interfaces);

}  // namespace myotact::prepare
