#pragma once

#include <memory>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "anatomy/specimen.h"
#include "core/pose.h"
#include "messages/local_model.h"

// Only in builds with Bullet; for bullet_engine alone.

namespace myotact::layer {

/// The bones of a specimen as rigid bodies of a Bullet world.
///
///   body below a hinge --> btRigidBody at its centre of mass, axes of its inertia, a hull for each bone
///   any other body     --> btCollisionObject for each bone, a triangle mesh where it lies at rest
///
/// X_WL of a body maps its rest position to now. Single caller. Not real-time safe.
class BulletWorld {
 public:
  /// Throws Error BadData for joints other than hinges and welds.
  BulletWorld(const anatomy::Specimen& specimen, const Vec3& gravity_m_s2);
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;
  ~BulletWorld();

  void advance(double h_s);  // one substep; forces and torques given before it act during it and are forgotten

  bool moves(int body) const { return bodies_[index(body)].rigid != nullptr; }
  Pose body_pose(int body) const;
  Vec3 point_velocity_m_s(int body, const Vec3& p_W) const;
  /// How fast a unit force on the point along `direction` speeds it up, the body taken for itself [1/kg].
  double mobility_1_kg(int body, const Vec3& p_W, const Vec3& direction) const;
  void push(int body, const Vec3& p_W, const Vec3& force_N);
  void apply_torque(int joint, double torque_Nm);  // child against parent, about the axis

  /// Right-hand rotation of the child about the joint's axis; 0 for a joint that does not rotate.
  double angle_rad(int joint) const;
  double velocity_rad_s(int joint) const;

  /// What a body of that shape at `middle_m` would meet: all points where it is inside of a bone, in no order; the
  /// surface is the bone's number.
  std::vector<messages::ReportedContact> contacts(btConvexShape& shape, const Vec3& middle_m) const;

 private:
  struct Body {
    std::unique_ptr<btRigidBody> rigid;  // null: stands still
    Pose X_LB;                           // of Bullet's body frame at rest
    std::vector<int> bones;              // children of the compound shape, in order
  };
  struct Hinge {
    std::unique_ptr<btTypedConstraint> constraint;  // null: a weld between bodies that stand still
    bool rotates = false;
    const anatomy::Joint* joint = nullptr;
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  void add_fixed_bone(const anatomy::Specimen& specimen, int bone);
  void add_moving_body(const anatomy::Specimen& specimen, int body);
  void add_joint(const anatomy::Joint& joint);
  btTransform frame_in_body(int body, const btTransform& X_LJ) const;

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  // Declared before what uses them: destroyed after.
  std::vector<std::unique_ptr<btStridingMeshInterface>> meshes_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  btRigidBody ground_{0.0, nullptr, nullptr};              // what joints to bodies that stand still hang on
  std::vector<std::unique_ptr<btCollisionObject>> fixed_;  // user index: the bone
  std::vector<Body> bodies_;                               // rigid's user index: the body
  std::vector<anatomy::Joint> joints_;
  std::vector<Hinge> hinges_;  // one a joint
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
};

}  // namespace myotact::layer
