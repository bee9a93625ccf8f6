#pragma once

#include <string>
#include <vector>

#include "prepare/partition/part_volume.h"
#include "prepare/recipe/anatomy_data.h"

namespace myotact::prepare {

/// A tendon that a volume had not: between a muscle and the bone that it is fixed to.
struct LaidTendon {
  std::string muscle, bone;
  double gap_m = 0.0;     // the muscle ended so far from the bone
  double length_m = 0.0;  // of the tendon
  double radius_m = 0.0;
};

/// Leads muscles that end in the air to their bones: a round tendon runs from the muscle's nearest point to the bone
/// where the recipe says that it is fixed, round bones and other tendons, and round muscles where the way is short;
/// what it still meets of these it takes; what is thin stays whole. Its area is the attachment's, as measured, or
/// that of the muscle's own end where that is less. Muscles and bones that the volume has not are passed over, so are
/// attachments to the trunk. Margins follow. In the recipe's order.
std::vector<LaidTendon> lay_tendons(PartVolume& volume, const std::vector<MuscleData>& muscles);

}  // namespace myotact::prepare
