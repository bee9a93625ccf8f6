#pragma once

#include "geometry/tet_mesh.h"
#include "geometry/triangle_mesh.h"
#include "simulation/skin/skin_embedding.h"

namespace myotact::simulation {

/// Lets a skin follow its mesh without kinks. Quadratic tets bend smoothly, but from one to the next their surface
/// turns: a dent under a hand has a few flat sides, and a sphere in it lies on one and the other by turns. So each
/// vertex follows the nodes around it instead of those of its own tet alone, by moving least squares of first order
/// (Lancaster and Salkauskas, Math. Comp. 37, 1981):
///
///   x = sum w_n x_n,   w_n = phi_n p_n^T M^-1 p,   M = sum phi_n p_n p_n^T,   p = (1, place),   phi = (1 - (r/h)^2)^2
///
/// with h as far as the nearest 30 reach. What the nodes do in common, shift, rotation and even stretch, is followed
/// exactly, and at rest nothing changes. A force on the vertex enters the tissue over a patch of that size; where nodes
/// lie so far apart that it would be wider than a fingertip's, the vertex keeps to its tet, little by little. So do
/// those that were pulled in, and meshes that are linear or have hardly more nodes. `embedding`: of that skin in that
/// mesh.
void smooth_embedding(const geometry::TriangleMesh& skin, const geometry::TetMesh& tets, SkinEmbedding& embedding);

}  // namespace myotact::simulation
