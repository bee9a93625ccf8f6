#pragma once

#include <vector>

#include "prepare/guess/decision.h"
#include "prepare/guess/markups.h"
#include "prepare/recipe/anatomy_data.h"
#include "prepare/recipe/named_surface.h"

namespace myotact::prepare {

/// Bodies, one a bone, and the joints that hold them together.
struct GuessedSkeleton {
  std::vector<anatomy::Body> bodies;   // as the bones
  std::vector<anatomy::Joint> joints;  // a tree: marked ones first, then welds where bones lie nearest to each other
  std::vector<int> steps_from_root;    // one a body
  Vec3 root_m = Vec3::Zero();          // middle of the root
};

/// The root is the bone that trunks or limbs begin with by its name, else the topmost. A marked joint whose bones are
/// not named joins the two that lie nearest to the middle of its axis. Masses are those of solid bone. Throws Error
/// BadData when marked joints close a ring.
GuessedSkeleton guess_skeleton(const std::vector<NamedSurface>& bones, const std::vector<MarkedJoint>& marked,
                               std::vector<Decision>& decisions);

/// Adds mass to a body as a point at its centre of mass, with the inertia of a ball.
void add_flesh(anatomy::Body& body, double mass_kg);

/// A body of 1 kg about that place: for muscles without bones.
anatomy::Body stand_at(const Vec3& middle_m);

}  // namespace myotact::prepare
