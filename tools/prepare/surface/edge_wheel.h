#pragma once

#include <span>
#include <vector>

#include "prepare/surface/edge_table.h"

namespace myotact::prepare {

/// A triangle at an edge, like a spoke of a wheel about it.
struct SpokeTriangle {
  int side;      // that runs along the edge
  bool forward;  // from the lower vertex to the higher
  double angle;  // about the direction low -> high [rad]
};

/// The triangles at an edge, by rising angle. Forward triangles look along rising angles, the others back.
std::vector<SpokeTriangle> wheel_around(const geometry::TriangleMesh& mesh, int low, int high,
                                        std::span<const EdgeUse> uses);

}  // namespace myotact::prepare
