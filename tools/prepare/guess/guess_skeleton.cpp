#include "prepare/guess/guess_skeleton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "prepare/guess/muscle_contacts.h"
#include "prepare/surface/edge_table.h"

namespace myotact::prepare {

namespace {

/// Compact bone with its marrow, as assets/canine takes it [kg/m3].
constexpr double kBoneDensity_kg_m3 = 1800.0;
/// No body is lighter: the skeleton's equations would be stiff.
constexpr double kLeastMass_kg = 1e-3;
/// Of a joint that was marked and not measured, about the file pose [rad]: 30 degrees are within every joint of a limb.
constexpr double kRange_rad = 0.52;
/// As in assets/canine: small beside those of muscles.
constexpr double kStiffness_Nm_rad = 0.1, kDamping_Nms_rad = 0.02;
/// A hand places a point in a picture about as well as that [m]; the axis over 30 mm as well as that [rad].
constexpr double kCentreUncertainty_m = 3e-3, kAxisUncertainty_rad = 0.17;
/// Distances between bones are measured from so many of the smaller one's vertices.
constexpr std::size_t kMostSamples = 1500;

const std::array<const char*, 8> kRoots = {"trunk", "vertebra", "sacrum",  "pelvis",
                                           "coxae", "ilium",    "scapula", "thorax"};

struct Box {
  Vec3 middle_m = Vec3::Zero();
  Vec3 size_m = Vec3::Constant(1e-3);
};

Box box_of(const geometry::TriangleMesh& surface) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : surface.positions_m) box.extend(p);
  if (box.isEmpty()) return {};
  return {box.center(), box.sizes()};
}

/// Of a box of even density about its middle, each side at least a millimetre.
std::array<double, 6> box_inertia_kg_m2(double mass_kg, const Vec3& size_m) {
  const Vec3 square = size_m.cwiseMax(1e-3).cwiseAbs2() * (mass_kg / 12.0);
  return {square.y() + square.z(), square.x() + square.z(), square.x() + square.y(), 0.0, 0.0, 0.0};
}

/// An open or inside-out surface still has about the volume of its box times what bones fill of theirs.
double bone_volume_m3(const geometry::TriangleMesh& surface) {
  constexpr double kFilled = 0.3;
  const double boxed_m3 = box_of(surface).size_m.prod();
  const double enclosed_m3 = std::abs(geometry::enclosed_volume_m3(surface));
  return enclosed_m3 > 0.0 && enclosed_m3 < 1.001 * boxed_m3 ? enclosed_m3 : kFilled * boxed_m3;
}

anatomy::Body body_of(const NamedSurface& bone) {
  const Box box = box_of(bone.surface);
  anatomy::Body body;
  body.key = bone.key;
  body.mass_kg = std::max(kLeastMass_kg, kBoneDensity_kg_m3 * bone_volume_m3(bone.surface));
  body.com_m = box.middle_m;
  body.inertia_kg_m2 = box_inertia_kg_m2(body.mass_kg, box.size_m);
  return body;
}

/// Where two bones come nearest.
struct Gap {
  double distance_m = std::numeric_limits<double>::infinity();
  Vec3 middle_m = Vec3::Zero();
};

Gap gap_between(const geometry::TriangleMesh& a, const BoneDistance& b) {
  Gap gap;
  const std::size_t stride = std::max<std::size_t>(1, a.positions_m.size() / kMostSamples);
  for (std::size_t v = 0; v < a.positions_m.size(); v += stride) {
    Vec3 place_m;
    const double distance_m = b.nearest_m(a.positions_m[v], place_m);
    if (distance_m < gap.distance_m) gap = {distance_m, 0.5 * (a.positions_m[v] + place_m)};
  }
  return gap;
}

int choose_root(const std::vector<NamedSurface>& bones) {
  for (const char* name : kRoots) {
    for (std::size_t b = 0; b < bones.size(); ++b) {
      if (bones[b].key.find(name) != std::string::npos) return static_cast<int>(b);
    }
  }
  int topmost = 0;
  for (int b = 1; b < static_cast<int>(bones.size()); ++b) {
    if (box_of(bones[at(b)].surface).middle_m.z() > box_of(bones[at(topmost)].surface).middle_m.z()) topmost = b;
  }
  return topmost;
}

class Builder {
 public:
  Builder(const std::vector<NamedSurface>& bones, std::vector<Decision>& decisions)
      : bones_(bones), decisions_(decisions), groups_(bones.size()) {
    for (const NamedSurface& bone : bones) {
      skeleton_.bodies.push_back(body_of(bone));
      distances_.emplace_back(bone.surface);
    }
  }

  void add_marked(const MarkedJoint& marked) {
    anatomy::Joint joint;
    joint.key = marked.key;
    joint.centre_m = 0.5 * (marked.axis_m[0] + marked.axis_m[1]);
    joint.axes = {(marked.axis_m[1] - marked.axis_m[0]).normalized().normalized()};  // as a reader leaves it
    joint.range_rad = {{-kRange_rad, kRange_rad}};
    joint.stiffness_Nm_rad = kStiffness_Nm_rad;
    joint.damping_Nms_rad = kDamping_Nms_rad;
    joint.centre_uncertainty_m = kCentreUncertainty_m;
    joint.axis_uncertainty_rad = kAxisUncertainty_rad;
    const auto [parent, child] = bones_of(marked, joint.centre_m);
    joint.parent = parent;
    joint.child = child;
    if (groups_.group_of(parent) == groups_.group_of(child)) {
      throw bad_data("markups", fmt::format("joint {}", joint.key),
                     fmt::format("joins {} and {}, which other joints hold together already; remove one",
                                 bones_[at(parent)].key, bones_[at(child)].key));
    }
    groups_.join(parent, child);
    skeleton_.joints.push_back(std::move(joint));
  }

  /// Welds along the shortest gaps, as many as it takes (Kruskal).
  void weld_rest() {
    std::vector<std::tuple<double, int, int, Vec3>> gaps;
    const int count = static_cast<int>(bones_.size());
    for (int a = 0; a < count; ++a) {
      for (int b = a + 1; b < count; ++b) {
        const bool a_smaller = bones_[at(a)].surface.positions_m.size() <= bones_[at(b)].surface.positions_m.size();
        const Gap gap = a_smaller ? gap_between(bones_[at(a)].surface, distances_[at(b)])
                                  : gap_between(bones_[at(b)].surface, distances_[at(a)]);
        gaps.emplace_back(gap.distance_m, a, b, gap.middle_m);
      }
    }
    std::stable_sort(gaps.begin(), gaps.end(),
                     [](const auto& a, const auto& b) { return std::get<0>(a) < std::get<0>(b); });
    for (const auto& [distance_m, a, b, middle_m] : gaps) {
      if (groups_.group_of(a) == groups_.group_of(b)) continue;
      groups_.join(a, b);
      anatomy::Joint weld;
      weld.type = anatomy::JointType::Weld;
      weld.parent = a;
      weld.child = b;
      weld.centre_m = middle_m;
      skeleton_.joints.push_back(std::move(weld));
    }
  }

  /// From the root outwards: a joint's child is the body farther out.
  GuessedSkeleton finish() {
    const int root = choose_root(bones_);
    skeleton_.root_m = skeleton_.bodies[at(root)].com_m;
    skeleton_.steps_from_root.assign(bones_.size(), -1);
    skeleton_.steps_from_root[at(root)] = 0;
    for (std::size_t turn = 0; turn < bones_.size(); ++turn) {
      for (anatomy::Joint& joint : skeleton_.joints) reach(joint);
    }
    for (std::size_t j = 0; j < skeleton_.joints.size(); ++j) tell(skeleton_.joints[j], j);
    return std::move(skeleton_);
  }

 private:
  std::pair<int, int> bones_of(const MarkedJoint& marked, const Vec3& centre_m) {
    if (marked.parent >= 0) return {marked.parent, marked.child};
    if (bones_.size() < 2) {
      throw bad_data("markups", "joint " + marked.key, "joins two bones, and the limb has fewer; name more as bones");
    }
    std::vector<std::pair<double, int>> nearest;
    for (int b = 0; b < static_cast<int>(bones_.size()); ++b) {
      Vec3 place_m;
      nearest.emplace_back(distances_[at(b)].nearest_m(centre_m, place_m), b);
    }
    std::sort(nearest.begin(), nearest.end());
    return {nearest[0].second, nearest[1].second};
  }

  void reach(anatomy::Joint& joint) {
    int& parent = skeleton_.steps_from_root[at(joint.parent)];
    int& child = skeleton_.steps_from_root[at(joint.child)];
    if (parent >= 0 && child < 0) child = parent + 1;
    if (child < 0 || parent >= 0) return;
    parent = child + 1;
    std::swap(joint.parent, joint.child);
    for (Vec3& axis : joint.axes) axis = -axis;  // the other bone turns now: the other way about the same line
  }

  void tell(anatomy::Joint& joint, std::size_t j) {
    const std::string &parent = bones_[at(joint.parent)].key, &child = bones_[at(joint.child)].key;
    if (joint.key.empty()) joint.key = parent + "_" + child;
    const std::string pointer = fmt::format("/joints/{}", j);
    if (joint.type == anatomy::JointType::Weld) {
      decisions_.push_back({"joints",
                            joint.key,
                            fmt::format("{} is fixed to {}; where they move, mark the axis (a Line named \"joint NAME "
                                        "{} {}\"), or make it a hinge in the recipe",
                                        child, parent, parent, child),
                            {},
                            pointer});
      return;
    }
    decisions_.push_back(
        {"joints",
         joint.key,
         fmt::format("{} turns on {} about the marked axis by {:.0f} degrees either way: not measured; "
                     "a right-hand rotation of {} must flex",
                     child, parent, kRange_rad * 57.29577951308232, child),
         {},
         pointer + "/range_rad"});
  }

  const std::vector<NamedSurface>& bones_;
  std::vector<Decision>& decisions_;
  Groups groups_;
  std::vector<BoneDistance> distances_;
  GuessedSkeleton skeleton_;
};

}  // namespace

GuessedSkeleton guess_skeleton(const std::vector<NamedSurface>& bones, const std::vector<MarkedJoint>& marked,
                               std::vector<Decision>& decisions) {
  if (bones.empty()) return {};
  Builder builder(bones, decisions);
  for (const MarkedJoint& joint : marked) builder.add_marked(joint);
  builder.weld_rest();
  return builder.finish();
}

void add_flesh(anatomy::Body& body, double mass_kg) {
  constexpr double kFlesh_kg_m3 = 1060.0;  // muscle, as assets/canine takes it
  const double radius_m = std::cbrt(0.75 * mass_kg / (kFlesh_kg_m3 * 3.141592653589793));
  body.mass_kg += mass_kg;
  for (std::size_t i = 0; i < 3; ++i) body.inertia_kg_m2[i] += 0.4 * mass_kg * radius_m * radius_m;
}

anatomy::Body stand_at(const Vec3& middle_m) {
  anatomy::Body body;
  body.key = "stand";
  body.mass_kg = 1.0;
  body.com_m = middle_m;
  body.inertia_kg_m2 = box_inertia_kg_m2(1.0, Vec3::Constant(0.1));
  return body;
}

}  // namespace myotact::prepare
