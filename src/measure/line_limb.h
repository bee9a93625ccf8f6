#pragma once

#include <span>
#include <vector>

#include "anatomy/specimen.h"
#include "scene/co_contraction.h"

namespace myotact::measure {

/// Bodies, joints, lines, and muscles with the lines' mechanics and no mesh: quickly copied.
anatomy::Specimen lines_of(const anatomy::Specimen& whole);

/// The limb reduced to bones, joints and muscle lines: cheap enough to be evaluated for every "what if". Its muscles
/// have the lines' mechanics and no mesh.
struct LineLimb {
  anatomy::Specimen specimen;
  scene::CoContraction set;         // joint, driven sides, difference; its level is not used
  std::vector<double> activations;  // of the muscles that are not driven
};

/// Of a scene that has a co_contraction.
LineLimb line_limb(const scene::Scene& scene);

/// Stiffness of the muscle lines about the joint, -d(torque)/dq at held activations, with the two sides balanced by the
/// lines' own torques at the level `common`. `angles_rad`: one a joint. The joint's own spring is not in it.
double balanced_line_stiffness_Nm_rad(const LineLimb& limb, std::span<const double> angles_rad, double common);

/// Stiffness that the weight of the bones adds about the joint, in a gravity field.
double weight_stiffness_Nm_rad(const LineLimb& limb, std::span<const double> angles_rad, const Vec3& gravity_m_s2);

}  // namespace myotact::measure
