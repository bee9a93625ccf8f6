#if defined(__GNUC__) && !defined(__clang__)
// g++ 12 takes an empty allocator inside of Bullet's arrays for an uninitialised value.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "layer/bullet_tissue.h"

#include <algorithm>

#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "geometry/tet_mesh.h"
#include "layer/bullet_contacts.h"
#include "layer/bullet_vectors.h"
#include "simulation/muscle/tissue_material.h"

namespace myotact::layer {
namespace {

int count_of(std::size_t size) {
  return static_cast<int>(size);
}
/// Our muscle across its fibres, but for its volume: linear tets lock at 3 MPa. 200 kPa leave a Poisson ratio of 0.476.
constexpr simulation::StableNeoHookean kMatrix{simulation::kMuscleMatrix.matrix.shear_Pa, 200e3};
/// Of the stiffness, times the step: a press comes to rest within a few steps, and no slower.
constexpr double kDamping = 0.01;

/// The spring of a tool on a material point, inside of the implicit step.
class PointSpring final : public btDeformableLagrangianForce {
 public:
  PointSpring(const btSoftBody& body, const simulation::ToolSpring& spring)
      : body_(body),
        point_(spring.point),
        target_(to_bullet(spring.target_W_m)),
        stiffness_N_m_(spring.stiffness_N_m) {}

  /// With the nodes where they are, or where this iterate wants them.
  btVector3 force_N(bool iterate) const {
    btVector3 place(0.0, 0.0, 0.0);
    for (std::size_t k = 0; k < at(point_.count); ++k) {
      place += point_.weights[k] * (iterate ? node(k).m_q : node(k).m_x);
    }
    return stiffness_N_m_ * (target_ - place);
  }

  void addScaledForces(btScalar scale, TVStack& force) override { addScaledExplicitForce(scale, force); }
  void addScaledExplicitForce(btScalar scale, TVStack& force) override {
    const btVector3 whole = scale * force_N(true);
    for (std::size_t k = 0; k < at(point_.count); ++k) force[node(k).index] += point_.weights[k] * whole;
  }
  void addScaledElasticForceDifferential(btScalar scale, const TVStack& moved, TVStack& change) override {
    btVector3 place(0.0, 0.0, 0.0);
    for (std::size_t k = 0; k < at(point_.count); ++k) place += point_.weights[k] * moved[node(k).index];
    for (std::size_t k = 0; k < at(point_.count); ++k) {
      change[node(k).index] -= scale * stiffness_N_m_ * point_.weights[k] * place;
    }
  }
  void addScaledDampingForce(btScalar, TVStack&) override {}
  void addScaledDampingForceDifferential(btScalar, const TVStack&, TVStack&) override {}
  void buildDampingForceDifferentialDiagonal(btScalar, TVStack&) override {}
  double totalElasticEnergy(btScalar) override {
    return stiffness_N_m_ > 0.0 ? 0.5 * force_N(true).length2() / stiffness_N_m_ : 0.0;
  }
  btDeformableLagrangianForceType getForceType() override { return BT_MOUSE_PICKING_FORCE; }

 private:
  const btSoftBody::Node& node(std::size_t k) const { return body_.m_nodes[point_.nodes[k]]; }

  const btSoftBody& body_;
  simulation::MaterialPoint point_;
  btVector3 target_;
  double stiffness_N_m_;
};

/// A quarter of each tet's mass a corner; 0, which clamps a node, where it hangs on a body.
std::vector<double> node_masses_kg(const anatomy::Muscle& muscle) {
  std::vector<double> masses_kg(muscle.tets.nodes_m.size(), 0.0);
  for (std::size_t t = 0; t < muscle.tets.corners.size(); ++t) {
    const double quarter_kg =
        0.25 * simulation::kMuscleMatrix.density_kg_m3 * geometry::corner_volume_m3(muscle.tets, t);
    for (const int node : muscle.tets.corners[t]) masses_kg[at(node)] += quarter_kg;
  }
  for (std::size_t n = 0; n < masses_kg.size(); ++n) {
    if (muscle.attachments[n] >= 0) masses_kg[n] = 0.0;
  }
  return masses_kg;
}

btSoftBody::TetraScratch empty_scratch() {
  btSoftBody::TetraScratch scratch;
  for (btMatrix3x3* matrix : {&scratch.m_F, &scratch.m_corotation, &scratch.m_cofF}) matrix->setIdentity();
  scratch.m_trace = 3.0;
  scratch.m_J = 1.0;
  return scratch;
}

void check_clamps(const anatomy::Specimen& specimen) {
  std::vector<bool> moved(specimen.bodies.size(), false);
  for (const anatomy::Joint& joint : specimen.joints) moved[at(joint.child)] = true;
  for (const anatomy::Muscle& muscle : specimen.muscles) {
    const auto on_moved = std::find_if(muscle.attachments.begin(), muscle.attachments.end(),
                                       [&](int body) { return body >= 0 && moved[at(body)]; });
    if (on_moved == muscle.attachments.end()) continue;
    throw bad_data(specimen.name, "",
                   fmt::format("muscle {}: hangs on {}, which a joint moves; Bullet's tissue is clamped to what stands "
                               "still: use our own simulation",
                               muscle.key, specimen.bodies[at(*on_moved)].key));
  }
}

}  // namespace

struct BulletTissue::World {
  struct Muscle {
    std::unique_ptr<btSoftBody> body;
    std::unique_ptr<btDeformableNeoHookeanForce> matrix;
    std::unique_ptr<btDeformableGravityForce> weight;
    std::vector<int> triangles;  // vertices of the skin, three a triangle
    std::vector<Vec3> skin_m;
    std::unique_ptr<btTriangleIndexVertexArray> mesh;  // over both
    std::unique_ptr<btBvhTriangleMeshShape> shape;
    std::unique_ptr<btCollisionObject> touched;  // user index: the muscle
  };

  explicit World(const Vec3& gravity_m_s2) : gravity(to_bullet(gravity_m_s2)) {
    constraints.setDeformableSolver(&solver);
    world.setImplicit(true);
    world.setUseProjection(true);
    world.setGravity(gravity);
  }
  ~World() {
    for (const Muscle& muscle : muscles) world.removeSoftBody(muscle.body.get());
  }

  void add(const anatomy::Muscle& given, const simulation::SkinEmbedding& skin);
  void add_body(const anatomy::Muscle& given, Muscle& made);
  void add_skin(const anatomy::Muscle& given, Muscle& made);
  void follow(const simulation::SkinEmbedding& skin, Muscle& muscle);

  btVector3 gravity;
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btDeformableBodySolver solver;
  btDeformableMultiBodyConstraintSolver constraints;
  btDeformableMultiBodyDynamicsWorld world{&dispatcher, &broadphase, &constraints, &configuration, &solver};
  std::vector<Muscle> muscles;
  std::vector<Vec3> nodes_m;  // scratch
};

void BulletTissue::World::add_body(const anatomy::Muscle& given, Muscle& made) {
  std::vector<btVector3> places;
  for (const Vec3& x : given.tets.nodes_m) places.push_back(to_bullet(x));
  const std::vector<double> masses_kg = node_masses_kg(given);
  made.body =
      std::make_unique<btSoftBody>(&world.getWorldInfo(), count_of(places.size()), places.data(), masses_kg.data());
  btSoftBody& body = *made.body;
  for (const auto& [a, b, c, d] : given.tets.corners) body.appendTetra(a, b, c, d);
  btSoftBodyHelpers::generateBoundaryFaces(&body);
  body.initializeDmInverse();
  body.m_tetraScratches.resize(body.m_tetras.size(), empty_scratch());
  body.m_tetraScratchesTn.resize(body.m_tetras.size(), empty_scratch());
  body.m_cfg.collisions = 0;  // muscles touch nothing here
  body.m_cfg.kDP = 0.0;
  body.m_useSelfCollision = false;
  body.setActivationState(DISABLE_DEACTIVATION);
  world.addSoftBody(&body, btBroadphaseProxy::DefaultFilter, 0);
  made.matrix =
      std::make_unique<btDeformableNeoHookeanForce>(kMatrix.shear_term_Pa(), kMatrix.volume_term_Pa(), kDamping);
  world.addForce(&body, made.matrix.get());
  made.weight = std::make_unique<btDeformableGravityForce>(gravity);
  world.addForce(&body, made.weight.get());
}

void BulletTissue::World::add_skin(const anatomy::Muscle& given, Muscle& made) {
  made.skin_m = given.skin.positions_m;
  for (const auto& triangle : given.skin.triangles) {
    made.triangles.insert(made.triangles.end(), triangle.begin(), triangle.end());
  }
  static_assert(sizeof(Vec3) == 3 * sizeof(btScalar));
  made.mesh = std::make_unique<btTriangleIndexVertexArray>(count_of(given.skin.triangles.size()), made.triangles.data(),
                                                           count_of(3 * sizeof(int)), count_of(made.skin_m.size()),
                                                           made.skin_m.front().data(), count_of(sizeof(Vec3)));
  made.shape = std::make_unique<btBvhTriangleMeshShape>(made.mesh.get(), true);
  made.shape->setMargin(0.0);
  made.touched = std::make_unique<btCollisionObject>();
  made.touched->setCollisionShape(made.shape.get());
  made.touched->setUserIndex(count_of(muscles.size()));
}

void BulletTissue::World::add(const anatomy::Muscle& given, const simulation::SkinEmbedding& skin) {
  Muscle made;
  add_body(given, made);
  add_skin(given, made);
  muscles.push_back(std::move(made));  // the heap's arrays stay where they are
  follow(skin, muscles.back());
}

void BulletTissue::World::follow(const simulation::SkinEmbedding& skin, Muscle& muscle) {
  nodes_m.clear();
  for (int n = 0; n < muscle.body->m_nodes.size(); ++n) nodes_m.push_back(from_bullet(muscle.body->m_nodes[n].m_x));
  simulation::update_skin(skin, nodes_m, muscle.skin_m);
  btVector3 low, high;
  muscle.mesh->calculateAabbBruteForce(low, high);
  muscle.shape->refitTree(low, high);
}

BulletTissue::BulletTissue(const anatomy::Specimen& specimen, const Vec3& gravity_m_s2) {
  check_clamps(specimen);
  world_ = std::make_unique<World>(gravity_m_s2);
  for (const anatomy::Muscle& muscle : specimen.muscles) {
    skins_.push_back(simulation::embed_skin(muscle.skin, muscle.tets));
    world_->add(muscle, skins_.back());
  }
}

BulletTissue::~BulletTissue() = default;

void BulletTissue::advance(double step_s, std::span<const simulation::ToolSpring> springs, std::span<Vec3> force_N) {
  std::vector<std::unique_ptr<PointSpring>> pulls(springs.size());
  for (std::size_t s = 0; s < springs.size(); ++s) {
    if (springs[s].muscle < 0) continue;
    btSoftBody& body = *world_->muscles[at(springs[s].muscle)].body;
    pulls[s] = std::make_unique<PointSpring>(body, springs[s]);
    world_->world.addForce(&body, pulls[s].get());
  }
  world_->world.stepSimulation(step_s, 0);  // 0: exactly one step of that length
  for (std::size_t s = 0; s < springs.size(); ++s) {
    if (!pulls[s]) continue;
    force_N[s] = from_bullet(pulls[s]->force_N(false));
    world_->world.removeForce(world_->muscles[at(springs[s].muscle)].body.get(), pulls[s].get());
  }
  for (std::size_t m = 0; m < skins_.size(); ++m) world_->follow(skins_[m], world_->muscles[m]);
}

std::span<const Vec3> BulletTissue::skin_world_m(int muscle) const {
  return world_->muscles[at(muscle)].skin_m;
}

std::vector<messages::ReportedContact> BulletTissue::contacts(btConvexShape& shape, const Vec3& middle_m) const {
  btCollisionObject tool;
  tool.setCollisionShape(&shape);
  tool.setWorldTransform(to_bullet(Pose{Mat3::Identity(), middle_m}));
  ContactCollector collector(tool);
  for (const World::Muscle& muscle : world_->muscles) {
    world_->world.contactPairTest(&tool, muscle.touched.get(), collector);
  }
  std::vector<messages::ReportedContact> contacts;
  for (const ContactCollector::Found& found : collector.found) {
    contacts.push_back(found.contact);
    contacts.back().surface = found.touched->getUserIndex();
  }
  return contacts;
}

}  // namespace myotact::layer
