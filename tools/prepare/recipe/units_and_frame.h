#pragma once

#include <string>

#include "prepare/recipe/anatomy_data.h"
#include "prepare/recipe/read_scan.h"

namespace myotact::prepare {

/// Brings the scan to metres, in the recipe's frame. `units` is "m", "cm", "mm" or "in", or empty: then the unit is
/// that of the recipe, and where it has none that in which the scan is as large as the recipe's attachments are spread,
/// and a note reports it. Throws Error BadData when no unit fits, when the limb would be smaller than 5 cm (5 mm in a
/// named unit) or larger than 3 m, when it lies elsewhere than the recipe's attachments, or when it is their mirror
/// image.
void set_units_and_frame(Scan& scan, const AnatomyData& recipe, const std::string& units);

}  // namespace myotact::prepare
