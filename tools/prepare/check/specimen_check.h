#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"

namespace myotact::prepare {

/// What a specimen that loads still falls short of: crossings, flat tets, skins outside their tets, volumes that
/// differ, muscles that hang on one body only. One sentence each, with file, place, value and limit.
std::vector<std::string> find_violations(const anatomy::Specimen& specimen);

}  // namespace myotact::prepare
