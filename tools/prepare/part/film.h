#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/triangle_mesh.h"
#include "prepare/field/block_lattice.h"
#include "prepare/field/level_set.h"

namespace myotact::prepare {

/// Ways through a closed surface: its genus, all pieces together, from Euler's V - E + F = 2 (pieces - genus).
int genus(const geometry::TriangleMesh& surface);

/// A muscle that its neighbours reach through, or that falls apart.
struct PiercedBody {
  Eigen::AlignedBox3d box;
  BodyField distance;            // to its surface before parting, negative inside [m]
  BodyField left;                // what is left of it is negative [m]
  BodyField impassable;          // what the film must keep out of is positive: bone [m]
  std::vector<Vec3> loose_ends;  // places of pieces that are to stay besides the largest one
};

/// Lattice nodes that close the handles of what is left of a muscle, and hold its pieces together: through the middle
/// of the muscle where a neighbour reaches through it, over the bone where that stands out of it. Found by hollowing a
/// full block of nodes from outside, the places where film is least wanted first, as long as no handle opens (Aktouf,
/// Bertrand and Perroton 2002): what cannot be taken away is film.
class Film {
 public:
  Film(const PiercedBody& body, double spacing_m);

  bool empty() const { return nodes_.empty(); }
  /// The balls of that radius around the nodes, as closed surfaces.
  geometry::TriangleMesh surface(double radius_m) const;
  /// Distance to the nodes [m], exact at the lattice's nodes near them; farther off less than it.
  double distance_m(const Vec3& p) const {
    return std::max(lattice_.interpolate(distances_m_, p), box_.exteriorDistance(p));
  }

 private:
  void measure_distances();

  BlockLattice lattice_;
  std::vector<std::size_t> nodes_;
  Eigen::AlignedBox3d box_;  // of the nodes
  std::vector<float> distances_m_;
};

}  // namespace myotact::prepare
