#pragma once

#include <memory>
#include <span>
#include <vector>

#include "anatomy/specimen.h"
#include "core/vector.h"
#include "messages/local_model.h"
#include "simulation/limb/limb.h"
#include "simulation/skin/skin_embedding.h"

class btConvexShape;

// Only in builds with Bullet; for bullet_engine alone.

namespace myotact::layer {

/// The muscles of a specimen as deformable bodies of Bullet on the specimen's own tets: neo-Hookean, implicit, without
/// fibres and tendons. What hangs on a body is clamped where it lies at rest. Single caller.
class BulletTissue {
 public:
  /// `specimen` outlives this. Throws Error BadData for a muscle that hangs on a body that a joint moves.
  BulletTissue(const anatomy::Specimen& specimen, const Vec3& gravity_m_s2);
  ~BulletTissue();

  std::span<const simulation::SkinEmbedding> skins() const { return skins_; }  // in the tets as the specimen has them
  /// One implicit step; each spring pulls at its material point, a weighted sum of nodes of one muscle, during it.
  /// `force_N`: of each spring on the tissue at its end; those of bones are left alone.
  void advance(double step_s, std::span<const simulation::ToolSpring> springs, std::span<Vec3> force_N);
  std::span<const Vec3> skin_world_m(int muscle) const;
  /// What a body of that shape would meet, as BulletWorld::contacts(); surfaces are the muscles.
  std::vector<messages::ReportedContact> contacts(btConvexShape& shape, const Vec3& middle_m) const;

 private:
  struct World;
  std::vector<simulation::SkinEmbedding> skins_;
  std::unique_ptr<World> world_;
};

}  // namespace myotact::layer
