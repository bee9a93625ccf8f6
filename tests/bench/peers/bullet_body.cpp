#include "bullet_body.h"

#include <cmath>

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableLinearElasticityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <btBulletDynamicsCommon.h>

namespace myotact::peers {

struct BulletBody::World {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btDeformableBodySolver solver;
  btDeformableMultiBodyConstraintSolver constraints;
  btDeformableMultiBodyDynamicsWorld world{&dispatcher, &broadphase, &constraints, &configuration, &solver};
  std::unique_ptr<btSoftBody> body;
  std::unique_ptr<btDeformableLagrangianForce> elastic, weight;

  World() { constraints.setDeformableSolver(&solver); }
};

namespace {

/// Bullet takes the terms of the stable law as they stand in the energy; so that both are the same body, it gets ours.
std::unique_ptr<btDeformableLagrangianForce> elastic_force(const PeerBody& body, BulletLaw law) {
  if (law == BulletLaw::LinearCorotated) {
    return std::make_unique<btDeformableLinearElasticityForce>(body.shear_Pa(), body.lambda_Pa(), 0.0, 0.0);
  }
  const simulation::StableNeoHookean same{body.shear_Pa(), body.lambda_Pa()};
  return std::make_unique<btDeformableNeoHookeanForce>(same.shear_term_Pa(), same.volume_term_Pa(), 0.0);
}

std::unique_ptr<btSoftBody> make_soft_body(const PeerBody& body, const Eigen::VectorXd& mass_kg,
                                           btSoftBodyWorldInfo& info) {
  std::vector<btVector3> places;
  for (const Vec3& x : body.mesh.nodes_m) places.emplace_back(x.x(), x.y(), x.z());
  auto soft = std::make_unique<btSoftBody>(&info, static_cast<int>(places.size()), places.data(), mass_kg.data());
  for (const auto& tet : body.mesh.corners) soft->appendTetra(tet[0], tet[1], tet[2], tet[3]);
  soft->initializeDmInverse();
  btSoftBody::TetraScratch at_rest{};
  for (btMatrix3x3* matrix : {&at_rest.m_F, &at_rest.m_cofF, &at_rest.m_corotation}) matrix->setIdentity();
  at_rest.m_trace = 3.0;
  at_rest.m_J = 1.0;
  soft->m_tetraScratches.resize(soft->m_tetras.size(), at_rest);
  soft->m_tetraScratchesTn.resize(soft->m_tetras.size(), at_rest);
  for (const int n : body.held) soft->setMass(n, 0.0);
  soft->m_cfg.collisions = 0;
  soft->m_cfg.drag = 0.0;
  soft->m_cfg.kDP = 0.0;
  soft->m_sleepingThreshold = 0.0;
  soft->setSelfCollision(false);
  soft->setActivationState(DISABLE_DEACTIVATION);
  return soft;
}

}  // namespace

BulletBody::BulletBody(const PeerBody& body, const Eigen::VectorXd& mass_kg, BulletLaw law, bool line_search)
    : world_(std::make_unique<World>()) {
  const btVector3 gravity(0.0, -kGravity_m_s2, 0.0);
  world_->world.setGravity(gravity);
  world_->world.getWorldInfo().m_gravity = gravity;
  world_->world.setImplicit(true);
  world_->world.setLineSearch(line_search);
  world_->world.setUseProjection(true);
  world_->body = make_soft_body(body, mass_kg, world_->world.getWorldInfo());
  world_->world.addSoftBody(world_->body.get());
  world_->elastic = elastic_force(body, law);
  world_->weight = std::make_unique<btDeformableGravityForce>(gravity);
  world_->world.addForce(world_->body.get(), world_->elastic.get());
  world_->world.addForce(world_->body.get(), world_->weight.get());
}

BulletBody::~BulletBody() {
  world_->world.removeSoftBody(world_->body.get());
}

bool BulletBody::step() {
  world_->world.stepSimulation(kStep_s, 1, kStep_s);
  return std::isfinite(world_->body->m_nodes[world_->body->m_nodes.size() - 1].m_x.y());
}

std::vector<double> BulletBody::positions_m() const {
  std::vector<double> result;
  for (int n = 0; n < world_->body->m_nodes.size(); ++n) {
    for (int i = 0; i < 3; ++i) result.push_back(world_->body->m_nodes[n].m_x[i]);
  }
  return result;
}

}  // namespace myotact::peers
