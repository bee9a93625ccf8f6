#pragma once

#include <string>
#include <vector>

#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

/// A segment of a volume that is to become a part.
struct ChosenSegment {
  std::string key;
  int label = 0, layer = 0;
};

/// What smoothing did to a part.
struct SmoothedPart {
  double voxels_m3 = 0.0;   // volume of its voxels
  double kept_m3 = 0.0;     // of its lattice points in the end
  double dropped_m3 = 0.0;  // of pieces besides the largest one
  int pieces = 0;           // before
};

/// Parts with smooth borders from a segmentation of any sampling: on a lattice of equal steps along the same
/// directions, every point goes to the part whose voxels, blurred by a Gaussian of about a step, weigh most there,
/// nothing being one of them; the margin is what they are ahead by. Thin parts, which blurring starves, are given
/// weight until they keep their volume. Only the largest piece of each stays. Layers may overlap. At most `most_points`
/// lattice points.
PartVolume smooth_labels(const LabelVolume& volume, const std::vector<ChosenSegment>& segments, double most_points,
                         int threads, std::vector<SmoothedPart>& parts);

}  // namespace myotact::prepare
