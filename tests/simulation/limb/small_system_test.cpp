#include "simulation/limb/small_system.h"

#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"

// A Newton step as the limb takes it, muscle after muscle eliminated in single precision and springs as unknown forces,
// against one dense system of all nodes and joints with the springs as plain stiffness.

namespace myotact::simulation {
namespace {

/// What single-precision factors leave of these small bars, relative.
constexpr double kEliminated = 2e-3;

/// Everything out of balance: nodes shaken, joint bent and turning, both muscles active.
Limb shaken_limb(unsigned seed) {
  Limb limb(testing::coarse_antagonist_hinge(), {}, Tendon::Elastic, Contact::None);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  limb.gravity_m_s2 = Vec3(1.0, 2.0, -9.0);
  limb.now.angle_rad[0] = 0.2 * normal(random);
  limb.last.angle_rad[0] = limb.now.angle_rad[0] - 0.01;
  limb.last.velocity_rad_s[0] = 0.5;
  limb.before = limb.last;
  follow_angles(limb);
  for (LimbMuscle& muscle : limb.muscles) {
    muscle.state.activation = 0.5 + 0.2 * normal(random);
    const Eigen::VectorXd change_m =
        Eigen::VectorXd::NullaryExpr(3 * muscle.tissue.free_nodes, [&] { return 1e-4 * normal(random); });
    move_free_nodes(muscle, change_m);
  }
  return limb;
}

/// A spring on a few nodes of a muscle, some of which may be clamped to a bone.
ToolSpring spring_on_muscle(const Limb& limb, int tool, int muscle, std::mt19937& random) {
  ToolSpring spring;
  spring.tool = tool;
  spring.muscle = muscle;
  spring.stiffness_N_m = 300.0 + static_cast<double>(random() % 700);
  spring.point.count = 4;
  const std::size_t nodes = limb.muscles[static_cast<std::size_t>(muscle)].tissue.body.size();
  for (std::size_t k = 0; k < 4; ++k) {
    spring.point.nodes[k] = static_cast<int>((random() % (nodes / 4)) * 4 + k);
    spring.point.weights[k] = 0.1 + 0.1 * static_cast<double>(k);
  }
  spring.target_W_m = spring_point(limb, spring) + Vec3(0.002, -0.001, 0.004);
  return spring;
}

ToolSpring spring_on_bone(const Limb& limb, int tool) {
  ToolSpring spring;
  spring.tool = tool;
  spring.body = 1;
  spring.body_rest_m = {0.17, 0.01, 0.0};
  spring.stiffness_N_m = 700.0;
  spring.target_W_m = spring_point(limb, spring) + Vec3(0.0, 0.001, 0.003);
  return spring;
}

/// The dense system, springs left out, and how each spring's point goes with its unknowns.
struct DenseStep {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd residual;
  std::vector<Eigen::Matrix3Xd> slopes;  // one a spring
  Eigen::Index joint = 0;                // the joint's row, after all nodes
};

/// `taken`: the limb that took the step, whose tangents may have had to be made definite.
DenseStep dense_step(Limb& limb, const Limb& taken, TissueLoad load) {
  DenseStep dense;
  for (const LimbMuscle& muscle : limb.muscles) dense.joint += 3 * muscle.tissue.free_nodes;
  dense.matrix = Eigen::MatrixXd::Zero(dense.joint + 1, dense.joint + 1);
  dense.residual = Eigen::VectorXd::Zero(dense.joint + 1);
  dense.slopes.assign(limb.springs.size(), Eigen::Matrix3Xd::Zero(3, dense.joint + 1));
  Eigen::Index first = 0;
  for (std::size_t m = 0; m < limb.muscles.size(); ++m) {
    LimbMuscle& muscle = limb.muscles[m];
    load.definite = taken.muscles[m].made_definite;
    compute_system(limb.skeleton, load, muscle, Accuracy::Refined);
    const Eigen::Index size = 3 * muscle.tissue.free_nodes;
    const TissueSystem& system = muscle.system;
    dense.matrix.block(first, first, size, size) =
        Eigen::MatrixXd(system.matrix.lower()).selfadjointView<Eigen::Lower>();
    dense.matrix.block(first, first, size, size) +=
        system.mean.factor_Nm * system.mean.gradient * system.mean.gradient.transpose();
    dense.matrix.block(first, dense.joint, size, 1) = system.coupling_N_rad;
    dense.matrix.block(dense.joint, first, 1, size) = system.coupling_N_rad.transpose();
    dense.matrix(dense.joint, dense.joint) += system.joint_stiffness_Nm_rad(0, 0);
    dense.residual.segment(first, size) = system.residual_N;
    dense.residual[dense.joint] += system.joint_residual_Nm[0];
    for (std::size_t s = 0; s < limb.springs.size(); ++s) {
      const ToolSpring& spring = limb.springs[s];
      for (std::size_t k = 0; spring.muscle == static_cast<int>(m) && k < 4; ++k) {
        const int f = muscle.tissue.free_index[static_cast<std::size_t>(spring.point.nodes[k])];
        if (f < 0) continue;
        dense.slopes[s].middleCols<3>(first + 3 * f) += spring.point.weights[k] * Mat3::Identity();
      }
    }
    first += size;
  }
  dense.residual[dense.joint] += skeleton_residual(limb, load.rule)[0];
  const double rate = load.rule.rate_1_s;
  dense.matrix(dense.joint, dense.joint) += rate * rate * limb.loads.mass_kg_m2(0, 0) +
                                            rate * limb.loads.damping_Nms_rad[0] + limb.loads.stiffness_Nm_rad(0, 0);
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    dense.slopes[s].col(dense.joint) = spring_slope(limb, limb.springs[s], 0);
  }
  return dense;
}

/// The limb's own way to the small system's solution; false when a muscle could not be factored.
bool eliminate_all(Limb& limb, const TissueLoad& load, SmallSystem& small) {
  limb.spring_compliance_m_N.assign(limb.springs.size(), Mat3::Zero());
  for (int m = 0; m < 2; ++m) {
    LimbMuscle& muscle = limb.muscles[static_cast<std::size_t>(m)];
    eliminate(limb, small, load, m, muscle);
    if (!muscle.sound) return false;
  }
  add_up(limb, load.rule, small);
  return true;
}

std::vector<ToolSpring> springs_of_three_tools(const Limb& limb, unsigned seed) {
  std::mt19937 random(seed);
  return {spring_on_muscle(limb, 0, 0, random), spring_on_bone(limb, 0), spring_on_muscle(limb, 1, 1, random),
          spring_on_muscle(limb, 2, 0, random)};
}

TEST(SmallSystem, JointsAndSpringsMoveAsInTheWholeSystem) {
  for (const unsigned seed : {101U, 102U, 103U}) {
    for (const TimeRule& rule : {second_order(0.01), backward_euler(0.002)}) {
      Limb limb = shaken_limb(seed), same = limb;
      limb.springs = same.springs = springs_of_three_tools(limb, seed);
      TissueLoad load;
      load.rule = rule;
      load.gravity_m_s2 = limb.gravity_m_s2;
      SmallSystem small = make_small_system(limb, Joints::Free);
      ASSERT_TRUE(eliminate_all(limb, load, small));
      const Eigen::VectorXd solution = small.matrix.partialPivLu().solve(small.right);

      DenseStep dense = dense_step(same, limb, load);
      std::vector<Vec3> gaps_m;
      for (std::size_t s = 0; s < same.springs.size(); ++s) {
        const ToolSpring& spring = same.springs[s];
        gaps_m.push_back(spring.target_W_m - spring_point(same, spring));
        dense.matrix += spring.stiffness_N_m * dense.slopes[s].transpose() * dense.slopes[s];
        dense.residual -= spring.stiffness_N_m * dense.slopes[s].transpose() * gaps_m[s];
      }
      const Eigen::VectorXd change = -dense.matrix.partialPivLu().solve(dense.residual);
      EXPECT_NEAR(solution[0], change[dense.joint], kEliminated * std::abs(change[dense.joint])) << seed;
      for (std::size_t s = 0; s < same.springs.size(); ++s) {
        const Vec3 force_N = same.springs[s].stiffness_N_m * (gaps_m[s] - dense.slopes[s] * change);
        EXPECT_LT((solution.segment<3>(small.spring_row(s)) - force_N).norm(), kEliminated * force_N.norm()) << s;
      }
    }
  }
}

/// How the point of spring `own` yields, with the springs of all tools but its own.
Mat3 dense_compliance_m_N(const DenseStep& dense, const Limb& limb, std::size_t own, bool locked) {
  Eigen::MatrixXd matrix = dense.matrix;
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    if (limb.springs[s].tool == limb.springs[own].tool) continue;
    matrix += limb.springs[s].stiffness_N_m * dense.slopes[s].transpose() * dense.slopes[s];
  }
  Eigen::Matrix3Xd slope = dense.slopes[own];
  if (locked) {  // no torque turns it
    matrix.row(dense.joint).setZero(), matrix.col(dense.joint).setZero();
    matrix(dense.joint, dense.joint) = 1.0;
    slope.col(dense.joint).setZero();
  }
  return slope * matrix.partialPivLu().solve(slope.transpose());
}

/// A hand feels the tissue with what the other hands do to it, and without its own springs.
TEST(SmallSystem, ComplianceIsThatOfTheWholeSystemWithoutTheToolsOwnSprings) {
  for (const unsigned seed : {104U, 105U}) {
    for (const bool locked : {false, true}) {
      Limb limb = shaken_limb(seed), same = limb;
      limb.skeleton.set_locked(0, locked);
      limb.springs = same.springs = springs_of_three_tools(limb, seed);
      TissueLoad load;
      load.rule = second_order(0.01);
      SmallSystem small = make_small_system(limb, Joints::Free);
      EXPECT_EQ(small.joints.empty(), locked);
      ASSERT_TRUE(eliminate_all(limb, load, small));
      const DenseStep dense = dense_step(same, limb, load);
      for (std::size_t own = 0; own < same.springs.size(); ++own) {
        const Mat3 expected_m_N = dense_compliance_m_N(dense, same, own, locked);
        EXPECT_LT((limb.spring_compliance_m_N[own] - expected_m_N).norm(), kEliminated * expected_m_N.norm() + 1e-12)
            << own << (locked ? " locked" : " free");
      }
    }
  }
}

}  // namespace
}  // namespace myotact::simulation
