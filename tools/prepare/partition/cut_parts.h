#pragma once

#include <vector>

#include "geometry/triangle_mesh.h"
#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

/// The closed surfaces of all parts of a volume, in the order of its keys. Metres, specimen frame.
struct CutParts {
  std::vector<geometry::TriangleMesh> fine;   // some thousand triangles each
  std::vector<geometry::TriangleMesh> skins;  // as they are touched and drawn; neighbours share their triangles
};

/// Cuts the parts apart and leaves as few triangles as their shape needs: fine surfaces lie within about 0.15 of a step
/// of the borders, skins within 0.3. All are closed, manifold, outward and free of crossings, and of the topology that
/// the labels have. Throws Error BadData naming the part whose surface crosses itself whatever is left in place. The
/// result does not depend on the number of threads.
CutParts cut_parts(const PartVolume& volume, int threads);

}  // namespace myotact::prepare
