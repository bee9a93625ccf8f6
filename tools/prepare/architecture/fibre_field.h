#pragma once

#include <string>
#include <vector>

#include "core/vector.h"
#include "geometry/tet_mesh.h"
#include "geometry/triangle_mesh.h"
#include "prepare/architecture/attachment_patch.h"

namespace myotact::prepare {

/// Fibre directions of a muscle: the gradient of a potential that solves Laplace's equation with a uniform flux in
/// through the origin, out through the insertion and none through the rest (Choi and Blemker 2013, PLoS ONE 8:e77576).
/// The whole flux is 1, so that 1/|gradient| is the cross-section along the fibres.
struct FibreField {
  std::vector<double> potential;        // one a node [1/m, for a flux of 1]; rises from origin to insertion
  std::vector<Vec3> gradient;           // one a tet [1/m2]
  std::vector<Vec3> direction;          // one a tet, unit, from origin to insertion
  int filled_tets = 0;                  // whose gradient was too small to be trusted: taken from their neighbours
  double mean_angle_to_axis_deg = 0.0;  // between fibres and the straight way from patch to patch, volume-weighted
};

/// The patches of one end, all of one kind: heads of an origin or tendons of an insertion.
using AttachmentPatches = std::vector<AttachmentPatch>;

/// `surface` is the tets' boundary; its vertices are the first nodes. The flux is spread evenly over all patches of an
/// end. Throws Error BadData when the potential cannot be solved for (the tets fall into separate parts).
FibreField solve_fibres(const std::string& name, const geometry::TetMesh& tets, const geometry::TriangleMesh& surface,
                        const AttachmentPatches& origins, const AttachmentPatches& insertions);

}  // namespace myotact::prepare
