#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"

namespace myotact::prepare {

/// What a specimen that loads still falls short of: crossings, flat tets, skins outside their tets, volumes that
/// differ, muscles that hang on one body only, overlaps that are not listed. One sentence each, with file, place, value
/// and limit. Muscles that could not be simulated at all are anatomy::find_defects()' business and passed over.
std::vector<std::string> find_violations(const anatomy::Specimen& specimen);

}  // namespace myotact::prepare
