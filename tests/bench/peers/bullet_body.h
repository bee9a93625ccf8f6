#pragma once

#include <memory>
#include <vector>

#include "peer_body.h"

namespace myotact::peers {

/// Laws of Bullet's deformable bodies that are laws of ours, too.
enum class BulletLaw { StableNeoHookean, LinearCorotated };

/// A body alone in a world of Bullet's deformable bodies: implicit, one Newton step, its own conjugate gradients, no
/// damping, no collisions, every node of the mass that ours has.
class BulletBody {
 public:
  BulletBody(const PeerBody& body, const Eigen::VectorXd& mass_kg, BulletLaw law, bool line_search);
  ~BulletBody();

  bool step();
  std::vector<double> positions_m() const;

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace myotact::peers
