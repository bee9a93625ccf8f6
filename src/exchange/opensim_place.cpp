#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include "core/at.h"
#include "core/text.h"
#include "exchange/opensim_convert.h"

namespace myotact::exchange::opensim {
namespace {

constexpr double kFull_rad = 2.0 * std::numbers::pi;
/// What has no mass in the model gets so little that nothing comes of it, as the links of hinge chains do.
constexpr double kLeastMass_kg = 1e-6, kLeastInertia_kg_m2 = 1e-11;

double value_at(const Joint& joint, const Motion& motion, const PoseValues& pose) {
  if (motion.coordinate < 0) return motion.function.at(0.0);
  return motion.function.at(pose.at(joint.coordinates[at(motion.coordinate)].name));
}

/// Whether the rotation follows its coordinate in the specimen: as a straight line, and nothing else of the joint does.
bool is_free(const Joint& joint, std::size_t index) {
  const Motion& motion = joint.rotations[index];
  if (motion.coordinate < 0) return false;
  const Coordinate& coordinate = joint.coordinates[at(motion.coordinate)];
  const bool shared = std::any_of(joint.rotations.begin(), joint.rotations.begin() + static_cast<int>(index),
                                  [&](const Motion& other) { return other.coordinate == motion.coordinate; });
  return coordinate.held.empty() && !shared && motion.function.is_line() &&
         motion.function.scale * motion.function.slope != 0.0;
}

/// Says what of the joint's motion a specimen does not have.
void tell_held(const Joint& joint) {
  std::string told;
  const auto add = [&](const std::string& text) { told += (told.empty() ? "" : "; ") + text; };
  for (std::size_t i = 0; i < 3; ++i) {
    const Motion& motion = joint.rotations[i];
    if (motion.coordinate < 0 || is_free(joint, i)) continue;
    const Coordinate& coordinate = joint.coordinates[at(motion.coordinate)];
    add(fmt::format("rotation {} is held where it is at the file pose, because {} {}", i + 1, coordinate.name,
                    coordinate.held.empty() ? "drives it by a curve or drives another, too" : coordinate.held));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Motion& motion = joint.translations[i];
    if (motion.coordinate < 0) continue;
    const Coordinate& coordinate = joint.coordinates[at(motion.coordinate)];
    const double travel_m = motion.function.travel(coordinate.range);
    if (travel_m == 0.0) continue;
    add(fmt::format("translation {} is held where it is at the file pose; {} moves it by {:.1f} mm over its range",
                    i + 1, coordinate.name, 1e3 * travel_m));
  }
  if (!told.empty()) joint.element.tell(told);
}

/// -1 where the coordinate extends: by its name, or, of a hinge of which the name says nothing, because limbs flex
/// farther than they extend.
double sense_of(const Coordinate& coordinate, bool hinge) {
  const std::string name = lower(coordinate.name);
  if (name.find("flex") != std::string::npos) return 1.0;
  if (name.find("exten") != std::string::npos) return -1.0;
  return hinge && -coordinate.range.first > 1.5 * std::max(0.0, coordinate.range.second) ? -1.0 : 1.0;
}

/// Adds the specimen's joint; X_LJ is the pose of its parent's frame, the axes as the file pose leaves them.
void add_joint(const Joint& joint, const Pose& X_LJ, std::vector<std::string>& keys, Placed& placed) {
  static constexpr anatomy::JointType kTypes[] = {anatomy::JointType::Weld, anatomy::JointType::Hinge,
                                                  anatomy::JointType::Universal, anatomy::JointType::Ball};
  anatomy::Joint made;
  made.key = key_of(joint.name, keys);
  made.parent = joint.parent;
  made.child = joint.child;
  Vec3 offset = Vec3::Zero();
  for (const Motion& motion : joint.translations) offset += value_at(joint, motion, placed.pose) * motion.axis;
  made.centre_m = X_LJ * offset;
  int free = 0;
  for (std::size_t i = 0; i < 3; ++i) free += is_free(joint, i) ? 1 : 0;
  Mat3 before = Mat3::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Motion& motion = joint.rotations[i];
    const double now = value_at(joint, motion, placed.pose);
    if (is_free(joint, i)) {
      const Coordinate& coordinate = joint.coordinates[at(motion.coordinate)];
      const double sense = sense_of(coordinate, free == 1),
                   rate = sense * motion.function.scale * motion.function.slope;
      const double zero = placed.pose.at(coordinate.name);
      const double a = std::clamp(rate * (coordinate.range.first - zero), -kFull_rad, kFull_rad);
      const double b = std::clamp(rate * (coordinate.range.second - zero), -kFull_rad, kFull_rad);
      if (std::abs(b - a) < 1e-9) throw joint.element.error("the range of " + coordinate.name + " is empty");
      placed.coordinates.push_back(
          {coordinate.name, made.key, made.axes.size(), rate, zero, coordinate.default_value, coordinate.range});
      made.axes.push_back(sense * (X_LJ.rotation * (before * motion.axis)).normalized());
      made.range_rad.emplace_back(std::min(a, b), std::max(a, b));
    }
    before = before * Eigen::AngleAxisd(now, motion.axis).toRotationMatrix();
  }
  made.type = kTypes[made.axes.size()];
  placed.specimen.joints.push_back(made);
  placed.X_LB[at(joint.child)] = Pose{X_LJ.rotation * before, made.centre_m} * joint.X_CJ.inverse();
}

void add_body(const Body& body, const Pose& X_LB, std::vector<std::string>& keys, Placed& placed) {
  anatomy::Body made;
  made.key = key_of(body.name, keys);
  made.com_m = X_LB * body.com_m;
  made.estimated = false;
  const auto& [xx, yy, zz, xy, xz, yz] = body.inertia_kg_m2;
  Mat3 own;
  own << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  made.mass_kg = body.mass_kg;
  if (!body.element) {  // the ground: it stands still
    made.mass_kg = 1.0;
    own = 1e-3 * Mat3::Identity();
  } else if (!(body.mass_kg > 0.0 && own(0, 0) > 0.0 && xx * yy > xy * xy && own.determinant() > 0.0)) {
    made.mass_kg = std::max(body.mass_kg, kLeastMass_kg);
    own = std::max(kLeastInertia_kg_m2, std::max({xx, yy, zz, 0.0})) * Mat3::Identity();
    made.estimated = true;
    body.element->tell("its mass or inertia is not positive: it gets as little as matters nothing");
  }
  const Mat3 turned = X_LB.rotation * own * X_LB.rotation.transpose();
  made.inertia_kg_m2 = {turned(0, 0), turned(1, 1), turned(2, 2), turned(0, 1), turned(0, 2), turned(1, 2)};
  placed.specimen.bodies.push_back(made);
}

/// The joints from the ground outward.
std::vector<const Joint*> in_order(const RawModel& raw) {
  std::vector<const Joint*> order;
  std::vector<char> reached(raw.bodies.size(), 0);
  std::vector<std::vector<const Joint*>> of_parent(raw.bodies.size());
  for (const Joint& joint : raw.joints) of_parent[at(joint.parent)].push_back(&joint);
  std::vector<int> open = {0};
  std::vector<char> has_joint(raw.bodies.size(), 0);
  for (const Joint& joint : raw.joints) has_joint[at(joint.child)] = 1;
  for (std::size_t b = 1; b < raw.bodies.size(); ++b) {
    if (has_joint[b]) continue;
    raw.bodies[b].element->tell("no joint carries it: it stands still at the ground's origin");
    open.push_back(static_cast<int>(b));
  }
  while (!open.empty()) {
    const int body = open.back();
    open.pop_back();
    reached[at(body)] = 1;
    for (const Joint* joint : of_parent[at(body)]) {
      if (joint->child == 0) throw joint->element.error("has the ground as its child; make it the parent");
      order.push_back(joint);
      open.push_back(joint->child);
    }
  }
  for (const Joint& joint : raw.joints) {
    if (reached[at(joint.child)]) continue;
    throw joint.element.error(
        fmt::format("carries the body {} in a ring of joints that never comes to the ground; cut the ring",
                    raw.bodies[at(joint.child)].name));
  }
  return order;
}

}  // namespace

Mat3 specimen_from_ground() {
  Mat3 rotation;
  rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return rotation;
}

std::string key_of(const std::string& name, std::vector<std::string>& used) {
  constexpr std::size_t kLongest = 80;
  std::string key;
  for (const char c : lower(name).substr(0, kLongest)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || (c == '.' && !key.empty());
    key += plain ? c : '_';
  }
  std::string unique = key;
  for (int i = 2; std::find(used.begin(), used.end(), unique) != used.end(); ++i) unique = fmt::format("{}_{}", key, i);
  used.push_back(unique);
  return unique;
}

PoseValues file_pose(const RawModel& raw, bool at_defaults) {
  PoseValues pose;
  for (const Joint& joint : raw.joints) {
    for (const Coordinate& c : joint.coordinates) {
      const bool may_be_0 = c.held.empty() && c.range.first <= 0.0 && c.range.second >= 0.0 && !at_defaults;
      pose[c.name] = may_be_0 ? 0.0 : c.default_value;
    }
  }
  return pose;
}

Placed place_skeleton(const RawModel& raw, const PoseValues& pose) {
  if (raw.bodies.size() < 2) throw bad_data(raw.file, "", "holds no <Body>; a specimen needs at least one");
  const bool grounded =
      std::any_of(raw.joints.begin(), raw.joints.end(), [](const Joint& joint) { return joint.parent == 0; });
  if (!grounded) {
    throw bad_data(raw.file, "", "no joint hangs on the ground; give one the socket_parent_frame /ground");
  }
  Placed placed;
  placed.pose = pose;
  placed.X_LB.assign(raw.bodies.size(), Pose{specimen_from_ground(), Vec3::Zero()});
  std::vector<std::string> joint_keys, body_keys;
  for (const Joint* joint : in_order(raw)) {
    tell_held(*joint);
    add_joint(*joint, placed.X_LB[at(joint->parent)] * joint->X_PJ, joint_keys, placed);
  }
  for (std::size_t b = 0; b < raw.bodies.size(); ++b) add_body(raw.bodies[b], placed.X_LB[b], body_keys, placed);
  return placed;
}

}  // namespace myotact::exchange::opensim
