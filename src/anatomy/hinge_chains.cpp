#include "anatomy/hinge_chains.h"

#include <fmt/format.h>

namespace myotact::anatomy {
namespace {

/// A link's inertia adds 1e-6 to that of the lightest limb part in assets/ (3e-5 kg m2) and leaves mass matrices
/// regular.
constexpr double kLinkMass_kg = 1e-6;
constexpr double kLinkInertia_kg_m2 = 1e-11;

int add_link(const Joint& joint, std::size_t axis, Specimen& specimen) {
  Body link;
  link.key = fmt::format("{}.link_{}", joint.key, axis + 1);
  link.mass_kg = kLinkMass_kg;
  link.com_m = joint.centre_m;
  link.inertia_kg_m2 = {kLinkInertia_kg_m2, kLinkInertia_kg_m2, kLinkInertia_kg_m2, 0.0, 0.0, 0.0};
  specimen.bodies.push_back(link);
  return static_cast<int>(specimen.bodies.size()) - 1;
}

/// The hinge about one of the joint's axes; parent and child are the caller's.
Joint hinge_about(const Joint& joint, std::size_t axis) {
  Joint hinge = joint;
  hinge.type = JointType::Hinge;
  if (axis > 0) hinge.key = fmt::format("{}.{}", joint.key, axis + 1);
  hinge.axes = {joint.axes[axis]};
  hinge.range_rad = {joint.range_rad[axis]};
  return hinge;
}

void expand(std::size_t index, Specimen& specimen) {
  const Joint joint = specimen.joints[index];
  int parent = joint.parent;
  for (std::size_t axis = 0; axis < joint.axes.size(); ++axis) {
    Joint hinge = hinge_about(joint, axis);
    const bool last = axis + 1 == joint.axes.size();
    hinge.parent = parent;
    hinge.child = parent = last ? joint.child : add_link(joint, axis, specimen);
    if (axis == 0) specimen.joints[index] = hinge;
    if (axis > 0) specimen.joints.push_back(hinge);
  }
}

}  // namespace

Specimen with_hinge_chains(Specimen specimen) {
  const std::size_t given = specimen.joints.size();
  for (std::size_t j = 0; j < given; ++j) {
    const JointType type = specimen.joints[j].type;
    if (type == JointType::Universal || type == JointType::Ball) expand(j, specimen);
  }
  return specimen;
}

}  // namespace myotact::anatomy
