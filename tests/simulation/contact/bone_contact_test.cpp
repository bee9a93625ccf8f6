#include "simulation/contact/bone_contact.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "simulation/contact/contact_law.h"
#include "simulation/limb/find_touches.h"
#include "simulation/limb/limb.h"
#include "simulation/limb/settle.h"
#include "simulation/limb/step.h"
#include "support/source_folder.h"
#include "support/wrapped_specimen.h"

namespace myotact::simulation {
namespace {

/// A bar under two hinges with unlike axes; the bone that it touches hangs on both, the one it is clamped to on one.
anatomy::Specimen bar_on_a_far_bone() {
  testing::BarShape shape;
  shape.cells = {3, 1, 1};
  anatomy::Specimen specimen = testing::single_muscle(shape);
  specimen.bodies.push_back(specimen.bodies[1]);
  specimen.bodies.back().key = "hand";
  anatomy::Joint wrist = specimen.joints[0];
  wrist.key = "wrist";
  wrist.parent = 1;
  wrist.child = 2;
  wrist.centre_m = {0.02, 0.005, -0.01};
  wrist.axes = {Vec3(0.6, 0.0, 0.8)};
  specimen.joints.push_back(wrist);
  specimen.bones.resize(1);
  specimen.bones[0].body = 2;
  specimen.bones[0].surface = testing::cylinder_surface({-0.03, 0.0, 0.005}, 0.015, 0.03);
  return specimen;
}

/// The one muscle in a deformed state, pressed into the bone.
struct Bench {
  Bench() : specimen(bar_on_a_far_bone()), limb(specimen) {
    muscle().state.activation = 0.6;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> noise(-3e-4, 3e-4);
    for (double& x : muscle().state.now.position_m) x += noise(random);
    for (std::size_t node = 0; node < muscle().tissue.body.size(); ++node) {
      muscle().state.now.position_m[static_cast<Eigen::Index>(3 * node) + 2] -= 3e-3;
    }
    turn({0.05, 0.04});
  }
  LimbMuscle& muscle() { return limb.muscles[0]; }
  void turn(const Eigen::Vector2d& angles) {
    limb.now.angle_rad = angles;
    follow_angles(limb);
  }
  /// Over the free nodes, then the joints.
  Eigen::VectorXd residual() {
    compute_forces(muscle().tissue, limb.skeleton, load, muscle().state, muscle().system);
    Eigen::VectorXd all(muscle().system.residual_N.size() + 2);
    all << muscle().system.residual_N, muscle().system.joint_residual_Nm;
    return all;
  }
  Eigen::MatrixXd tangent() {
    compute_system(muscle().tissue, limb.skeleton, load, muscle().state, muscle().system);
    const TissueSystem& system = muscle().system;
    const Eigen::Index n = system.residual_N.size();
    Eigen::MatrixXd whole(n + 2, n + 2);
    const Eigen::MatrixXd lower(system.matrix.lower());
    whole.topLeftCorner(n, n) = lower.selfadjointView<Eigen::Lower>();
    whole.topLeftCorner(n, n) += system.mean.factor_Nm * system.mean.gradient * system.mean.gradient.transpose();
    whole.topRightCorner(n, 2) = system.coupling_N_rad;
    whole.bottomLeftCorner(2, n) = system.coupling_N_rad.transpose();
    whole.bottomRightCorner(2, 2) = system.joint_stiffness_Nm_rad;
    return whole;
  }
  void move(const Eigen::VectorXd& by) {
    move_free_nodes(muscle(), by.head(by.size() - 2));
    turn(limb.now.angle_rad + by.tail<2>());
  }
  /// Central difference of the residual along a direction.
  Eigen::VectorXd slope(const Eigen::VectorXd& along, double h) {
    move(h * along);
    const Eigen::VectorXd up = residual();
    move(-2.0 * h * along);
    const Eigen::VectorXd down = residual();
    move(h * along);
    return (up - down) / (2.0 * h);
  }

  anatomy::Specimen specimen;
  Limb limb;
  TissueLoad load;
};

/// A block of muscle under the lower body's far end, on a flat bone of the upper body.
anatomy::Specimen block_on_a_table() {
  testing::BarShape shape;
  shape.origin_m = {0.14, 0.0, -0.04};
  shape.length_m = 0.02;
  shape.cells = {3, 3, 3};
  anatomy::Specimen specimen = testing::single_muscle(shape);
  anatomy::Muscle& block = specimen.muscles[0];
  for (std::size_t i = 0; i < block.attachments.size(); ++i) {
    block.attachments[i] = block.tets.nodes_m[i].z() > -0.03 - 1e-9 ? 1 : -1;
  }
  specimen.bones.resize(1);
  specimen.bones[0].surface =
      testing::boundary_surface(testing::box_mesh({0.11, -0.04, -0.07}, {0.08, 0.08, 0.02}, {8, 8, 2}));
  specimen.joints[0].stiffness_Nm_rad = 0.0;
  return specimen;
}

}  // namespace

TEST(BoneContact, TangentIsTheSlopeOfForcesAndTorques) {
  Bench bench;
  const Eigen::MatrixXd tangent = bench.tangent();
  EXPECT_GT(bench.muscle().system.contact_N, 5.0);
  EXPECT_LT((tangent - tangent.transpose()).norm(), 1e-12 * tangent.norm());
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(tangent.cols());
  for (Eigen::Index k = 0; k < tangent.cols(); ++k) {
    unit.setZero();
    unit[k] = 1.0;
    EXPECT_LT((bench.slope(unit, 1e-7) - tangent.col(k)).norm(), 2e-6 * tangent.cwiseAbs().maxCoeff())
        << "unknown " << k;
  }
}

TEST(BoneContact, ErrorOfTheTangentFallsWithTheSquareOfTheStep) {
  Bench bench;
  const Eigen::MatrixXd tangent = bench.tangent();
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  Eigen::VectorXd along(tangent.cols());
  for (double& value : along) value = normal(random);
  along.tail<2>() *= 30.0;  // turns that move the bone as far as the nodes
  const auto error = [&](double h) { return (bench.slope(along, h) - tangent * along).norm(); };
  EXPECT_NEAR(std::log2(error(4e-6) / error(2e-6)), 2.0, 0.2);
}

// The node pushes the bone as the bone pushes the node: turning a joint, the contact does the work of a force on the
// bone at the node.
TEST(BoneContact, TorquesAreThoseOfTheNodesForcesOnTheBone) {
  Bench bench;
  const Eigen::VectorXd with = bench.residual();
  const Eigen::VectorXd torque_with = bench.muscle().system.muscle_torque_Nm;
  bench.muscle().tissue.bone_contact.patches.clear();
  const Eigen::VectorXd force = with - bench.residual();  // of the contact alone: holds the nodes
  const Eigen::VectorXd torque = torque_with - bench.muscle().system.muscle_torque_Nm;
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(2);
  for (std::size_t node = 0; node < bench.muscle().tissue.body.size(); ++node) {
    const int f = bench.muscle().tissue.free_index[node];
    if (f < 0) continue;
    const Vec3 on_bone = force.segment<3>(3 * f);
    const Vec3 x = node_vector(bench.muscle().state.now.position_m, static_cast<int>(node));
    for (int j = 0; j < 2; ++j) expected[j] += on_bone.dot(bench.limb.skeleton.point_derivative(2, j, x));
  }
  EXPECT_GT(expected.norm(), 1e-2);
  EXPECT_LT((torque - expected).norm(), 1e-12 * expected.norm());
}

// The list of nodes near bones outlives many steps: nothing that touches may be missing from it, wherever muscle and
// bone wander meanwhile.
TEST(BoneContact, NodesThatWereLookedForEarlierMissNoTouch) {
  Bench kept, anew;
  for (Bench* bench : {&kept, &anew}) {
    for (Eigen::Index z = 2; z < bench->muscle().state.now.position_m.size(); z += 3)
      bench->muscle().state.now.position_m[z] += 12e-3;
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  int kept_lists = 0, touching = 0;
  for (int i = 20; i < 420; ++i) {  // away by 12 mm and back
    Eigen::VectorXd by(kept.residual().size());
    for (double& x : by) x = 2e-4 * noise(random);
    const Vec3 drift = 6e-4 * Vec3(noise(random), noise(random), i % 40 < 20 ? 1.0 : -1.0);
    for (Eigen::Index n = 0; n + 2 < by.size(); n += 3) by.segment<3>(n) += drift;
    by.tail<2>() = 0.004 * Eigen::Vector2d(noise(random), noise(random)) - 0.02 * kept.limb.now.angle_rad;
    kept.move(by);
    anew.move(by);
    const Eigen::VectorXd looked_for_at_m = kept.muscle().state.near_bones.position_m;
    anew.muscle().state.near_bones = {};
    ASSERT_EQ(kept.residual(), anew.residual()) << "move " << i;
    kept_lists += kept.muscle().state.near_bones.position_m == looked_for_at_m;
    touching += kept.muscle().system.contact_N > 0.0;
  }
  EXPECT_GT(kept_lists, 100);
  EXPECT_LT(kept_lists, 380);
  EXPECT_GT(touching, 100);
  EXPECT_LT(touching, 380);
}

TEST(BoneContact, ABlockOnATableBearsWhatPressesItAndHardlySinksIn) {
  const anatomy::Specimen specimen = block_on_a_table();
  Limb limb(specimen);
  WorkerPool workers(1);
  limb.external_torque_Nm[0] = -0.3;  // 2 N at 0.15 m
  const StepInput input{0.01, false};
  for (int i = 0; i < 60; ++i) {
    push_history(limb);
    ASSERT_TRUE(advance(limb, input, workers).sound);
  }
  const MuscleReadout& readout = limb.muscles[0].readout;
  EXPECT_NEAR(limb.now.velocity_rad_s[0], 0.0, 1e-4);
  EXPECT_NEAR(readout.torque_Nm[0], 0.3, 1e-3 * 0.3);
  EXPECT_NEAR(readout.contact_N, 2.0, 0.03 * 2.0);  // the block is wedged by a degree: not quite in its middle
  // p = F / A = 5 kPa in the law: sqrt(2 e p / k).
  EXPECT_LT(readout.contact_depth_m, 0.2e-3);
  EXPECT_GT(readout.contact_depth_m, 0.02e-3);
}

TEST(BoneContact, NothingPushesAtTheFilePose) {
  for (const char* name : {"canine_elbow", "canine_forelimb", "canine_hindlimb"}) {
    const anatomy::Specimen specimen = anatomy::load_specimen(source_folder() + "/meshes/" + name);
    const std::vector<TissueModel> springs(specimen.muscles.size(), TissueModel::MassSpring);
    Limb limb(specimen, springs);
    WorkerPool workers(1);
    find_touches(limb, workers);
    int inside = 0;
    for (LimbMuscle& muscle : limb.muscles) {
      compute_forces(muscle.tissue, limb.skeleton, {}, muscle.state, muscle.system);
      EXPECT_LT(muscle.system.contact_N, 1e-9) << name;
      for (const BonePatch& patch : muscle.tissue.bone_contact.patches) {
        for (const BonePatch::Node& node : patch.nodes) inside += node.rest_depth_m > 0.0;
      }
    }
    EXPECT_GT(inside, 0) << name << ": surfaces overlap there, or this tests nothing";
  }
}

TEST(BoneContact, AreasOfSurfaceNodesAddUp) {
  geometry::TetMesh box = testing::box_mesh(Vec3::Zero(), {0.1, 0.02, 0.03}, {4, 2, 2});
  const std::vector<int> free(10000, -1);
  for (const geometry::TetMesh& mesh : {box, geometry::make_quadratic(box)}) {
    double sum_m2 = 0.0;
    for (const SurfaceNode& node : surface_nodes(mesh, free, -1)) sum_m2 += node.area_m2;
    EXPECT_NEAR(sum_m2, 2.0 * (0.1 * 0.02 + 0.1 * 0.03 + 0.02 * 0.03), 1e-12);
  }
}

TEST(ContactLaw, PressureIsContinuousWithItsSlope) {
  const ContactLaw law{1e9, 1e-4};
  for (const double s : {0.0, 0.3e-4, 1e-4, 2e-4}) {
    const double h = 1e-9;
    const double slope =
        (contact_pressure(law, s + h).pressure_Pa - contact_pressure(law, s - h).pressure_Pa) / (2 * h);
    EXPECT_NEAR(contact_pressure(law, s).slope_Pa_m, slope, 1e-4 * law.stiffness_Pa_m);
  }
  EXPECT_EQ(contact_pressure(law, -1e-6).pressure_Pa, 0.0);
}

}  // namespace myotact::simulation
