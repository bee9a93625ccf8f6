#include "layer/bullet_world.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.h"
#include "layer/bullet_contacts.h"
#include "layer/bullet_vectors.h"

namespace myotact::layer {
namespace {

/// Bullet adds its margin of 40 mm around hulls and meshes unless set otherwise: more than a tool is wide.
constexpr double kMargin_m = 0.0;
/// Of the constraints in a substep; ten are Bullet's own choice, five times that keeps a chain of hinges together.
constexpr int kSolverIterations = 50;

/// The body frame at rest: centre of mass and axes of inertia, right-handed. `inertia_kg_m2`: about these axes.
Pose inertia_frame(const anatomy::Body& body, Vec3& inertia_kg_m2) {
  const auto& [xx, yy, zz, xy, xz, yz] = body.inertia_kg_m2;
  Mat3 inertia;
  inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  inertia_kg_m2 = solver.eigenvalues();
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  return {axes, body.com_m};
}

/// A frame at the joint whose z is its axis.
btTransform joint_frame(const anatomy::Joint& joint) {
  const Vec3 axis = joint.axes.empty() ? Vec3(Vec3::UnitZ()) : joint.axes[0];
  return to_bullet(Pose{Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix(), joint.centre_m});
}

/// Which bodies some hinge moves: those below one, and what is welded to them.
std::vector<bool> moving_bodies(const anatomy::Specimen& specimen) {
  std::vector<bool> moves(specimen.bodies.size(), false);
  for (std::size_t pass = 0; pass < specimen.joints.size(); ++pass) {
    for (const anatomy::Joint& joint : specimen.joints) {
      const bool moved = joint.type != anatomy::JointType::Weld || moves[static_cast<std::size_t>(joint.parent)];
      if (moved) moves[static_cast<std::size_t>(joint.child)] = true;
    }
  }
  return moves;
}

}  // namespace

BulletWorld::BulletWorld(const anatomy::Specimen& specimen, const Vec3& gravity_m_s2) : joints_(specimen.joints) {
  for (const anatomy::Joint& joint : joints_) {
    if (joint.type == anatomy::JointType::Hinge || joint.type == anatomy::JointType::Weld) continue;
    throw bad_data(specimen.name, "",
                   fmt::format("joint {}: is neither hinge nor weld; divide it into hinges", joint.key));
  }
  world_ = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher_, &broadphase_, &solver_, &configuration_);
  world_->setGravity(to_bullet(gravity_m_s2));
  world_->getSolverInfo().m_numIterations = kSolverIterations;
  bodies_.resize(specimen.bodies.size());
  const std::vector<bool> moves = moving_bodies(specimen);
  for (int b = 0; b < static_cast<int>(bodies_.size()); ++b) {
    if (moves[index(b)]) add_moving_body(specimen, b);
  }
  for (int b = 0; b < static_cast<int>(specimen.bones.size()); ++b) {
    if (!moves[index(specimen.bones[index(b)].body)]) add_fixed_bone(specimen, b);
  }
  for (const anatomy::Joint& joint : joints_) add_joint(joint);
}

BulletWorld::~BulletWorld() {
  for (const Hinge& hinge : hinges_) {
    if (hinge.constraint) world_->removeConstraint(hinge.constraint.get());
  }
  for (const Body& body : bodies_) {
    if (body.rigid) world_->removeRigidBody(body.rigid.get());
  }
}

void BulletWorld::add_fixed_bone(const anatomy::Specimen& specimen, int bone) {
  const geometry::TriangleMesh& surface = specimen.bones[index(bone)].surface;
  auto mesh = std::make_unique<btTriangleMesh>();
  for (const auto& [a, b, c] : surface.triangles) {
    mesh->addTriangle(to_bullet(surface.positions_m[index(a)]), to_bullet(surface.positions_m[index(b)]),
                      to_bullet(surface.positions_m[index(c)]));
  }
  auto shape = std::make_unique<btBvhTriangleMeshShape>(mesh.get(), true);
  shape->setMargin(kMargin_m);
  auto object = std::make_unique<btCollisionObject>();
  object->setCollisionShape(shape.get());
  object->setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
  object->setUserIndex(bone);
  meshes_.push_back(std::move(mesh));
  shapes_.push_back(std::move(shape));
  fixed_.push_back(std::move(object));
}

void BulletWorld::add_moving_body(const anatomy::Specimen& specimen, int body) {
  Body& made = bodies_[index(body)];
  Vec3 inertia_kg_m2;
  made.X_LB = inertia_frame(specimen.bodies[index(body)], inertia_kg_m2);
  auto shape = std::make_unique<btCompoundShape>();
  for (int b = 0; b < static_cast<int>(specimen.bones.size()); ++b) {
    if (specimen.bones[index(b)].body != body) continue;
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& x : specimen.bones[index(b)].surface.positions_m) {
      hull->addPoint(to_bullet(made.X_LB.inverse() * x), false);
    }
    hull->recalcLocalAabb();
    hull->setMargin(kMargin_m);
    shape->addChildShape(btTransform::getIdentity(), hull.get());
    shapes_.push_back(std::move(hull));
    made.bones.push_back(b);
  }
  const btRigidBody::btRigidBodyConstructionInfo info(specimen.bodies[index(body)].mass_kg, nullptr, shape.get(),
                                                      to_bullet(inertia_kg_m2));
  made.rigid = std::make_unique<btRigidBody>(info);
  made.rigid->setWorldTransform(to_bullet(made.X_LB));
  made.rigid->setInterpolationWorldTransform(to_bullet(made.X_LB));
  made.rigid->setActivationState(DISABLE_DEACTIVATION);  // what sleeps would not answer to a hand
  made.rigid->setUserIndex(body);
  world_->addRigidBody(made.rigid.get(), btBroadphaseProxy::DefaultFilter, 0);  // bones do not collide
  shapes_.push_back(std::move(shape));
}

btTransform BulletWorld::frame_in_body(int body, const btTransform& X_LJ) const {
  return moves(body) ? to_bullet(bodies_[index(body)].X_LB).inverse() * X_LJ : X_LJ;
}

void BulletWorld::add_joint(const anatomy::Joint& joint) {
  Hinge hinge;
  hinge.joint = &joint;
  hinge.rotates = joint.type == anatomy::JointType::Hinge;
  if (moves(joint.child)) {
    btRigidBody& child = *bodies_[index(joint.child)].rigid;
    btRigidBody& parent = moves(joint.parent) ? *bodies_[index(joint.parent)].rigid : ground_;
    const btTransform frame = joint_frame(joint);
    const btTransform in_child = frame_in_body(joint.child, frame), in_parent = frame_in_body(joint.parent, frame);
    if (hinge.rotates) {
      hinge.constraint = std::make_unique<btHingeConstraint>(child, parent, in_child, in_parent);
    } else {
      hinge.constraint = std::make_unique<btFixedConstraint>(parent, child, in_parent, in_child);
    }
    world_->addConstraint(hinge.constraint.get(), true);
  }
  hinges_.push_back(std::move(hinge));
}

Pose BulletWorld::body_pose(int body) const {
  if (!moves(body)) return {};
  const Body& here = bodies_[index(body)];
  return from_bullet(here.rigid->getWorldTransform()) * here.X_LB.inverse();
}

Vec3 BulletWorld::point_velocity_m_s(int body, const Vec3& p_W) const {
  if (!moves(body)) return Vec3::Zero();
  const btRigidBody& rigid = *bodies_[index(body)].rigid;
  return from_bullet(rigid.getVelocityInLocalPoint(to_bullet(p_W) - rigid.getCenterOfMassPosition()));
}

double BulletWorld::mobility_1_kg(int body, const Vec3& p_W, const Vec3& direction) const {
  if (!moves(body)) return 0.0;
  return bodies_[index(body)].rigid->computeImpulseDenominator(to_bullet(p_W), to_bullet(direction));
}

void BulletWorld::push(int body, const Vec3& p_W, const Vec3& force_N) {
  if (!moves(body)) return;
  btRigidBody& rigid = *bodies_[index(body)].rigid;
  rigid.applyForce(to_bullet(force_N), to_bullet(p_W) - rigid.getCenterOfMassPosition());
}

double BulletWorld::angle_rad(int joint) const {
  const Hinge& hinge = hinges_[index(joint)];
  if (!hinge.rotates) return 0.0;
  const Mat3 relative = body_pose(hinge.joint->parent).rotation.transpose() * body_pose(hinge.joint->child).rotation;
  const Eigen::Quaterniond q(relative);
  return 2.0 * std::atan2(q.vec().dot(hinge.joint->axes[0]), q.w());
}

double BulletWorld::velocity_rad_s(int joint) const {
  const Hinge& hinge = hinges_[index(joint)];
  if (!hinge.rotates) return 0.0;
  Vec3 velocity_rad_s = from_bullet(bodies_[index(hinge.joint->child)].rigid->getAngularVelocity());
  const Body& parent = bodies_[index(hinge.joint->parent)];
  if (parent.rigid) velocity_rad_s -= from_bullet(parent.rigid->getAngularVelocity());
  return velocity_rad_s.dot(body_pose(hinge.joint->parent).rotation * hinge.joint->axes[0]);
}

void BulletWorld::apply_torque(int joint, double torque_Nm) {
  const Hinge& hinge = hinges_[index(joint)];
  if (!hinge.rotates) return;
  const btVector3 torque = to_bullet(torque_Nm * (body_pose(hinge.joint->parent).rotation * hinge.joint->axes[0]));
  bodies_[index(hinge.joint->child)].rigid->applyTorque(torque);
  if (moves(hinge.joint->parent)) bodies_[index(hinge.joint->parent)].rigid->applyTorque(-torque);
}

void BulletWorld::advance(double h_s) {
  world_->stepSimulation(h_s, 0);  // 0: exactly one step of that length
}

std::vector<messages::ReportedContact> BulletWorld::contacts(btConvexShape& shape, const Vec3& middle_m) const {
  btCollisionObject tool;
  tool.setCollisionShape(&shape);
  tool.setWorldTransform(to_bullet(Pose{Mat3::Identity(), middle_m}));
  ContactCollector collector(tool);
  for (const auto& object : fixed_) world_->contactPairTest(&tool, object.get(), collector);
  for (const Body& body : bodies_) {
    if (body.rigid) world_->contactPairTest(&tool, body.rigid.get(), collector);
  }
  std::vector<messages::ReportedContact> contacts;
  for (ContactCollector::Found& found : collector.found) {
    const bool is_fixed = btRigidBody::upcast(found.touched) == nullptr;
    found.contact.surface = found.touched->getUserIndex();
    if (!is_fixed) {
      const Body& body = bodies_[index(found.touched->getUserIndex())];
      found.contact.surface = body.bones[index(found.child)];
    }
    contacts.push_back(found.contact);
  }
  return contacts;
}

}  // namespace myotact::layer
