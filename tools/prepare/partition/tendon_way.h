#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "prepare/part/node_steps.h"
#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

/// What one muscle's tendons may go through. The volume and `bone` (one entry a label) must outlive it.
class TendonGround {
 public:
  TendonGround(const PartVolume& volume, const std::vector<bool>& bone, std::uint16_t part);

  /// Bone, and where another part is so thin that it would be cut: most of all, another tendon.
  bool closed(std::size_t point) const;
  bool beside_bone(std::size_t point) const;
  /// Whether what the point belongs to stays in one piece without it, and gets no hole (is_simple()).
  bool leaves_whole(std::size_t point) const;
  /// A part that is neither bone nor this muscle.
  bool other_muscle(std::size_t point) const;
  bool own(std::size_t point) const { return volume_.labels[point] == part_; }

  const PartVolume& volume() const { return volume_; }

 private:
  std::uint16_t label(std::size_t point, std::ptrdiff_t step) const;
  /// No block of 5 x 5 x 5 points around it is all of its part.
  bool thin(std::size_t point) const;

  const PartVolume& volume_;
  const std::vector<bool>& bone_;
  std::uint16_t part_;
  NodeSteps steps_;
  std::vector<std::ptrdiff_t> block_;  // steps to the 5 x 5 x 5 points around one
};

/// The cheapest way over the lattice from a point of a bone's border to the ground's muscle: free points cost their
/// distance, those beside bone more, so that a tendon is not buried in it, those of other muscles much more. `to` is
/// the muscle's point nearest to `from`. Places from bone to muscle [m], evened out as far as the ground allows;
/// nothing when no way is to be found around the two.
std::optional<std::vector<Vec3>> find_tendon_way(const TendonGround& ground, std::size_t from, std::size_t to);

}  // namespace myotact::prepare
