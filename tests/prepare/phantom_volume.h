#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/vector.h"
#include "prepare/volume/label_volume.h"

// A phantom of known shapes: two spheres in contact, a bone, a muscle bent round it, a sheet. No mirror image of it is
// itself, so that an axis which is read the wrong way round is seen.

namespace myotact::testing {

enum PhantomLabel : int { kSphere = 1, kSmallSphere = 2, kBone = 3, kBentMuscle = 4, kSheet = 5 };

inline const std::array<std::string, 6> kPhantomNames = {"", "sphere", "small sphere", "bone", "bent muscle", "sheet"};

/// The label at a place, LPS millimetres; within 0 .. 40 mm along each axis.
int phantom_label(const Vec3& place_mm);

/// A lattice as files state it.
struct PhantomGrid {
  std::array<int, 3> counts = {20, 22, 21};
  Vec3 origin_mm = Vec3(0.13, 0.27, 0.41);  // LPS
  Mat3 steps_mm = 1.9 * Mat3::Identity();   // columns; LPS
  Vec3 place_mm(int i, int j, int k) const { return origin_mm + steps_mm * Vec3(i, j, k); }
};

/// The grid over the same places with axis a of the new one along axis order[a] of the old one, reversed where asked.
PhantomGrid reordered(const PhantomGrid& grid, const std::array<int, 3>& order, const std::array<bool, 3>& reverse);

/// All 48 orders and directions of the axes.
std::vector<PhantomGrid> all_orientations(const PhantomGrid& grid);

/// Turned about no axis in particular, with steps of 1.3, 1.9 and 3.1 mm.
PhantomGrid oblique_grid();

/// The labels of all points, x fastest.
std::vector<int> phantom_labels(const PhantomGrid& grid);

/// Whether every point of the volume, which is in the specimen frame, has the phantom's label at its place in `layer`.
/// Labels of the volume are `scale` times those of the phantom. Empty, or the first point that differs.
std::string phantom_difference(const prepare::LabelVolume& volume, int layer = 0, int scale = 1);

}  // namespace myotact::testing
