#include "simulation/follower/bone_gaps.h"

#include <algorithm>
#include <limits>

namespace myotact::simulation {

BoneSurfaces make_bone_surfaces(const anatomy::Specimen& specimen) {
  BoneSurfaces bones;
  for (const anatomy::Bone& bone : specimen.bones) {
    if (!bone.surface.triangles.empty()) bones.push_back({bone.body, geometry::SignedDistance(bone.surface)});
  }
  return bones;
}

BoneGap gap_to_bones(const BoneSurfaces& bones, const Skeleton& skeleton, const Vec3& p_W, double radius_m) {
  BoneGap gap{radius_m, Vec3::Zero()};
  for (const BoneSurface& bone : bones) {
    const Pose& X_WB = skeleton.body_pose(bone.body);
    const Vec3 p_B = X_WB.rotation.transpose() * (p_W - X_WB.translation_m);
    const double box_m = bone.surface.box_distance_m(p_B);
    if (box_m >= gap.distance_m) continue;
    // Outside the box the point is outside the bone, and only a nearer one counts; inside, a deeper one may.
    const geometry::SignedPlace place = bone.surface.nearest(p_B, box_m > 0.0 ? gap.distance_m : radius_m);
    if (place.found && place.distance_m < gap.distance_m) gap = {place.distance_m, X_WB.rotation * place.outward};
  }
  return gap;
}

BoneBounds bounds_at_rest(const BoneGap& gap) {
  const bool touches = gap.distance_m <= kTouchingGap_m;
  return {std::min(0.0, gap.distance_m),
          touches ? std::max(0.0, gap.distance_m) : std::numeric_limits<double>::infinity()};
}

double free_way_m(const BoneBounds& bounds, const BoneGap& gap) {
  return std::min(gap.distance_m - bounds.nearest_m, bounds.farthest_m - gap.distance_m);
}

}  // namespace myotact::simulation
