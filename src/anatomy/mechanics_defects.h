#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"

namespace myotact::anatomy {

/// What of find_defects() concerns a muscle's mechanics, whatever its mesh.
std::vector<std::string> find_mechanics_defects(const Muscle& muscle);

}  // namespace myotact::anatomy
