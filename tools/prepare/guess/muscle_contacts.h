#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/vector.h"
#include "geometry/triangle_tree.h"
#include "prepare/recipe/named_surface.h"

// Where a muscle's surface lies on bones, and the two places of these that are its ends.

namespace myotact::prepare {

/// The direction in which a surface is longest, and its tips there. A surface without area has both tips at a vertex.
struct LongAxis {
  Vec3 direction = Vec3::UnitX();  // unit; its largest component is positive
  double lowest_m = 0.0, highest_m = 0.0;
  /// The middle of what lies within a twentieth of the length of either end.
  std::array<Vec3, 2> tips_m{Vec3::Zero(), Vec3::Zero()};

  double length_m() const { return highest_m - lowest_m; }
};
LongAxis long_axis(const geometry::TriangleMesh& surface);

/// A bone that can be asked for its nearest point. Keeps a reference to the surface.
class BoneDistance {
 public:
  explicit BoneDistance(const geometry::TriangleMesh& surface);
  /// Distance to its surface [m]; infinity beyond `reach_m`.
  double distance_m(const Vec3& p, double reach_m) const;
  /// The same without bound, and the place.
  double nearest_m(const Vec3& p, Vec3& place_m) const;

 private:
  const geometry::TriangleMesh& surface_;
  geometry::TriangleTree tree_;
  Eigen::AlignedBox3d box_;
};

/// One connected patch of a muscle's surface on one bone.
struct MuscleContact {
  int bone = -1;
  Vec3 centre_m = Vec3::Zero();  // area-weighted, then the patch's nearest triangle to that
  double area_m2 = 0.0;
};

/// All patches within `reach_m` of bones. A patch that runs along more than half of the muscle counts as two, one in
/// the part towards either tip.
std::vector<MuscleContact> find_contacts(const geometry::TriangleMesh& muscle, const LongAxis& axis,
                                         const std::vector<BoneDistance>& bones, double reach_m);

/// The pair that is most likely origin and insertion: far apart, on different bones, not by a mere touch. Both -1 when
/// no two lie farther apart than a third of the muscle; then `first` is the largest, or -1.
struct ContactPair {
  int first = -1, second = -1;
};
ContactPair choose_ends(const std::vector<MuscleContact>& contacts, const geometry::TriangleMesh& muscle,
                        const LongAxis& axis);

}  // namespace myotact::prepare
