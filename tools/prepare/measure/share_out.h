#pragma once

#include <string>
#include <vector>

#include "prepare/measure/part_depths.h"
#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

/// A body that claims lattice points.
struct Claim {
  std::string key;
  bool bone = false;                 // bones keep all of theirs
  std::vector<DepthSample> samples;  // by rising number
};

/// What became of a claim.
struct Share {
  std::size_t claimed = 0;  // lattice points inside the body
  std::size_t in_bone = 0;  // of these: taken by bones
  std::size_t kept = 0;     // in the end
};

/// Every muscle keeps at least this part of what bones leave of it, as far as its neighbours can do without.
constexpr double kLeastShare = 0.6;

/// Gives every lattice point to one of the bodies that claim it: to a bone before muscles, else to the muscle in which
/// it lies deepest, measured against how thick that is there, so that thin ones lose no more than thick ones. Muscles
/// that would keep less than kLeastShare are favoured step by step until they do. Fills in margins, too. A claim's
/// number + 1 is its label; `shares` has one entry a claim.
PartVolume share_out(const Lattice& lattice, const std::vector<Claim>& claims, std::vector<Share>& shares);

}  // namespace myotact::prepare
