#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"

namespace myotact::anatomy {

/// What is wrong with the wrapping surfaces of a line whose points are well, one sentence a defect; `name` is how they
/// call the line. Checked at the file pose.
std::vector<std::string> find_wrap_defects(const MuscleLine& line, const std::string& name);

}  // namespace myotact::anatomy
