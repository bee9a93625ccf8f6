#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

/// The borders between the parts of a volume, and between them and the space around: triangles that may meet more than
/// two at an edge, where three parts or more come together.
struct Interfaces {
  struct Face {
    std::array<int, 3> vertices;         // counter-clockwise seen from `outer`
    std::uint16_t inner = 0, outer = 0;  // labels of the two sides; inner is a part, outer another or 0
  };
  std::vector<Vec3> positions_m;  // specimen frame
  std::vector<Face> faces;
};

/// Cuts the tetrahedra that the lattice's cubes fall into (six a cube, see level_set.h) between unlike nodes: an edge
/// where its two margins balance, and in tetrahedra of three or four parts around a point in the middle (Hege and
/// others 1997). What each part gets is closed and manifold and hangs together as its points do along edges of the
/// tetrahedra; neighbours share their triangles. Labels must be 0 in the outermost layer of the lattice.
Interfaces cut_interfaces(const PartVolume& volume);

/// The closed surfaces of labels 1 to `parts`.
std::vector<geometry::TriangleMesh> surfaces_of(const Interfaces& interfaces, int parts);

}  // namespace myotact::prepare
