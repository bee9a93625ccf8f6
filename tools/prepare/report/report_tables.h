#pragma once

#include <string>
#include <vector>

#include "prepare/limb_work.h"

// The tables of the HTML report, each one <table> element.

namespace myotact::prepare {

/// What each stage did to the limb as a whole.
std::string stages_table(const LimbWork& limb, int violations);
std::string bones_table(const LimbWork& limb);
/// Tets and their shape, attachments, what parting took.
std::string meshes_table(const LimbWork& limb);
/// Volume, mass, fibres, cross-section, force, moment arms.
std::string architecture_table(const LimbWork& limb);
/// Masses and fibre lengths beside the published ones; an empty text when the recipe has none.
std::string published_table(const LimbWork& limb);
std::string overlaps_table(const std::vector<anatomy::Overlap>& overlaps);

}  // namespace myotact::prepare
