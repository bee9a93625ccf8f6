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

/// Points outside a body are looked at up to here [steps].
constexpr double kDepthBand = 2.0;

/// All lattice points inside a surface and a little outside of it, by rising number. The surface must be closed,
/// outward and free of crossings; the lattice's steps equal.
std::vector<DepthSample> sample_depths(const geometry::TriangleMesh& surface, const Lattice& lattice);

}  // namespace myotact::prepare
