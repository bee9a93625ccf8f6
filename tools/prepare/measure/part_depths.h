#pragma once

#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "prepare/volume/label_volume.h"

namespace myotact::prepare {

/// How deep a lattice point lies in a body, and how thick the body is there. In steps of the lattice.
struct DepthSample {
  std::uint32_t point = 0;
  float depth = 0.0F;   // positive inside
  float radius = 0.0F;  // of the largest balls that fit inside there
};

/// Points outside a body are looked at up to here [steps]: margins reach 2, of a body that thicken() moved out by 1.
constexpr double kDepthBand = 3.0;

/// Bodies are thickened to this radius where they are thinner [steps]: a tube of .87 holds a point of the lattice
/// wherever it lies, and what a neighbour takes of this one leaves it whole. Tendons of a paw are of .6 to 1 mm.
constexpr float kLeastRadius = 1.2F;

/// Moves the surface out until no ball inside is smaller than kLeastRadius.
void thicken(std::vector<DepthSample>& samples);

/// All lattice points inside a surface and a little outside of it, by rising number. The surface must be closed,
/// outward and free of crossings; the lattice's steps equal.
std::vector<DepthSample> sample_depths(const geometry::TriangleMesh& surface, const Lattice& lattice);

}  // namespace myotact::prepare
