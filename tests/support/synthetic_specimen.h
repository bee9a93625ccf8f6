#pragma once

#include <array>

#include "anatomy/specimen.h"

// Small specimens with closed-form answers: straight bars of muscle between two bodies joined by a hinge.
// Made without files; every part that anatomy/specimen.h asks for is present.

namespace myotact::testing {

/// Box of 6 tets a cell, edges along the axes, lowest corner at `origin_m`. Every corner volume is positive.
geometry::TetMesh box_mesh(const Vec3& origin_m, const Vec3& size_m, const std::array<int, 3>& cells);

/// Outer surface of a tet mesh, triangles outward, only the vertices on it.
geometry::TriangleMesh boundary_surface(const geometry::TetMesh& mesh);

/// A muscle bar of square section whose fibres run along +x from `origin_m` (the middle of its first end).
struct BarShape {
  Vec3 origin_m{-0.09, 0.0, 0.03};
  double length_m = 0.12;
  double width_m = 0.02;
  std::array<int, 3> cells{6, 2, 2};
  int tendon_cells = 0;  // cells along x, at the insertion, that are tendon
};

/// Muscle with F0 = 300 kPa times its section and an optimal fibre length at which G = rest_stretch.
/// End nodes are attached to bodies 0 (x lowest) and 1 (x highest).
anatomy::Muscle bar_muscle(const std::string& key, const BarShape& shape);

/// Its straight line along the axis: origin, a via point where the belly ends if it has tendon cells, insertion.
anatomy::MuscleLine bar_line(int muscle, const BarShape& shape);

/// Bodies `upper` (0, fixed) and `lower` (1), bones along x, and the hinge `elbow` at the world origin about -y:
/// q > 0 lifts the lower body's far end towards +z. No muscles.
anatomy::Specimen hinged_bones();

/// hinged_bones() with `flexor` (above the joint, z > 0) and `extensor` (below), mirror images.
anatomy::Specimen antagonist_hinge();

/// The same of four cells each, for tests that take many steps.
anatomy::Specimen coarse_antagonist_hinge();

/// hinged_bones() with one muscle: the flexor of the given shape.
anatomy::Specimen single_muscle(const BarShape& shape);

}  // namespace myotact::testing
