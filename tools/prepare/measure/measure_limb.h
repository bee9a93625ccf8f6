#pragma once

#include <functional>
#include <string>
#include <vector>

#include "prepare/limb_work.h"
#include "prepare/measure/share_out.h"
#include "prepare/partition/lay_tendons.h"
#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

/// What a measured part is against the surface that it was measured on.
struct MeasuredPart {
  std::string key;
  Share share;              // lattice points
  std::size_t added = 0;    // to close holes that sharing out left, and to join pieces
  std::size_t dropped = 0;  // loose specks
};

struct MeasuredLimb {
  PartVolume volume;
  std::vector<MeasuredPart> parts;
  std::vector<LaidTendon> tendons;
};

/// A volume of all bones and muscles of a limb whose surfaces were repaired, on a lattice of that step along the axes
/// of the specimen frame: no part reaches into another (share_out.h), every muscle hangs together (keep_whole.h) and
/// reaches its bones (lay_tendons.h), and margins tell where its surface runs between the lattice's points. `measured`
/// is called after each part, from any thread. Throws Error BadData naming the part of which nothing is left, and Usage
/// when the lattice would have more than 2^31 points.
MeasuredLimb measure_limb(const LimbWork& limb, double step_m, const std::function<void()>& measured);

}  // namespace myotact::prepare
