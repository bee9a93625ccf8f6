#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"

namespace myotact::anatomy {

struct LineRules {
  double deepest_via_m = 0.0;  // so far inside a bone a via point may lie
  bool crosses_joint = true;   // its points are on more than one body
};

/// What makes one line of a specimen unusable, one sentence a defect, checked at the file pose; empty when all is well.
/// Its references must be valid.
std::vector<std::string> find_line_defects(const MuscleLine& line, const Specimen& specimen, const LineRules& rules);

}  // namespace myotact::anatomy
