#pragma once

#include <string>
#include <vector>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// The part of a muscle's surface that is fixed to bone at one end.
struct AttachmentPatch {
  std::vector<int> triangles;  // of the surface, connected
  std::vector<int> vertices;   // of those triangles, rising
  double area_m2 = 0.0;
  Vec3 centroid_m = Vec3::Zero();  // area-weighted
  double bone_distance_m = 0.0;    // of its nearest vertex
};

/// Where a patch should grow.
struct PatchGuide {
  geometry::TriangleMesh bones;  // that may carry it, joined; empty: the point alone guides
  Vec3 point_m = Vec3::Zero();   // known middle of the attachment
  double area_m2 = 0.0;          // wanted; raised to the least that a flux can pass
  int sites = 1;                 // at this end: they share what an end may cover
  std::vector<int> covered;      // triangles of the end's other sites: this patch may touch but not share them
};

/// Grows a patch from the vertex that is nearest to bone and guide point, always by the neighbour nearest to both,
/// until it has the wanted area, at least 3 % of the surface and at least 8 triangles: with less, the potential of the
/// fibre field has a pole there. `taken` marks triangles of the other end: they and their neighbours are left out.
/// Throws Error BadData naming the muscle and the distance when the surface is nowhere near the bones. A patch without
/// triangles: there was no room for another site.
AttachmentPatch grow_patch(const std::string& name, const geometry::TriangleMesh& surface, const PatchGuide& guide,
                           const std::vector<int>& taken = {});

}  // namespace myotact::prepare
