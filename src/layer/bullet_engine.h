#pragma once

#include <memory>
#include <vector>

#include "anatomy/specimen.h"
#include "core/vector.h"
#include "layer/engine.h"

namespace myotact::layer {

/// The body that a tool has in an engine.
struct ToolBody {
  enum class Shape { Sphere, Box };
  Shape shape = Shape::Sphere;
  double radius_m = 3e-3;  // half the edge of a box
};

struct BulletSettings {
  /// 60 Hz, at which games and their engines run: what the layer is for.
  double step_s = 1.0 / 60.0;
  /// Of a step. Bullet takes the springs of a hand explicitly: at 240 Hz one of 800 N/m rotates a plate of 87 g by 0.4
  /// rad of its swing, at 60 Hz by 1.6, where 2 is the end of what is stable.
  int substeps = 4;
  Vec3 gravity_m_s2 = Vec3::Zero();
  std::vector<ToolBody> tools = {ToolBody{}};
};

/// Whether this program was built with Bullet.
bool has_bullet();

/// Bullet Physics (zlib licence) behind the adapter, in double precision. Bodies that no hinge moves are triangle
/// meshes; those on hinges have mass, inertia and a convex hull of each of their bones. Bones do not collide with each
/// other. A joint is one of Bullet's constraints; its spring, damper and end of range are torques by the law of our own
/// simulation, since Bullet's hinges end hard.
///
/// A tool's body is no part of the world: Bullet's collision detection is asked what it meets, so it pushes nothing.
/// The springs of a tool (contact, bone in hand) pull at every substep with k (target - p - h v), the place at the end
/// of the substep as far as the velocity predicts it; stiffer than what brings the point home in one substep they are
/// not.
///
/// Bullet rounds its shapes by collision margins, 40 mm unless set, more than our tools are wide. Here they are zero
/// for hulls and meshes: a sphere on a face is then reported exactly (1e-9 m), while a box, which Bullet tests by
/// supporting points, is taken with the margin of its own that its maker needs, inside of its faces.
///
/// Muscles are deformable bodies on the specimen's own tets, one implicit step a step with the springs inside of it;
/// they have the matrix of ours but for its volume, no fibres, and hang on bodies that stand still. Their skins are
/// triangle meshes to the collision detection. The compliance under a press (LocalContact) is not reported.
///
/// Reads `specimen` when called only; throws Error BadData for what it cannot hold (joints other than hinges and welds,
/// muscles on bodies that a joint moves), Unavailable (69) when built without Bullet. Same calls, same bits.
std::unique_ptr<Engine> make_bullet_engine(const anatomy::Specimen& specimen, const BulletSettings& settings = {});

}  // namespace myotact::layer
