#pragma once

#include <memory>
#include <vector>

#include "anatomy/specimen.h"
#include "geometry/signed_distance.h"
#include "simulation/skeleton/skeleton.h"

namespace myotact::simulation {

/// A bone's surface at rest, and the body that carries it.
struct BoneSurface {
  int body = -1;
  geometry::SignedDistance surface;
};
using BoneSurfaces = std::vector<BoneSurface>;  // read only, may be shared by threads

/// All bones with triangles, in the specimen's order.
BoneSurfaces make_bone_surfaces(const anatomy::Specimen& specimen);

/// Where the nearest bone is. World frame.
struct BoneGap {
  double distance_m = 0.0;      // < 0 inside one; the radius asked for where none is nearer
  Vec3 outward = Vec3::Zero();  // unit: where the distance rises; 0 where none is nearer
};

/// The nearest of all bones to a world point, in the skeleton's pose, within `radius_m` > 0. Of bones that overlap the
/// one in which it lies deepest.
BoneGap gap_to_bones(const BoneSurfaces& bones, const Skeleton& skeleton, const Vec3& p_W, double radius_m);

/// A skin vertex against the bones at the file pose, from which both bounds follow.
struct BoneBounds {
  double nearest_m = 0.0;   // may come this near: 0, or as deep as it lies at rest
  double farthest_m = 0.0;  // may go this far: infinity for what does not touch
};

/// A vertex within this of a bone at the file pose touches it [m]: what neighbours that share no face keep between them
/// in a surface taken from voxels of 1 mm.
inline constexpr double kTouchingGap_m = 1e-3;

/// From the gap at the file pose.
BoneBounds bounds_at_rest(const BoneGap& gap);
/// How far a vertex may go before it can be out of bounds; < 0: by so much it is.
double free_way_m(const BoneBounds& bounds, const BoneGap& gap);

}  // namespace myotact::simulation
