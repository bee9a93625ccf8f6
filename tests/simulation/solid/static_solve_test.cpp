#include "simulation/solid/static_solve.h"

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/box_mesh.h"

namespace myotact::simulation {
namespace {

const Vec3 kBlock_m(0.4, 0.3, 0.5);

class BlockOf : public ::testing::TestWithParam<ElementKind> {
 protected:
  static SolidInput block(std::vector<Law> laws) {
    SolidInput input;
    input.kind = GetParam();
    input.mesh = geometry::make_box_mesh(kBlock_m, {2, 2, 3});
    if (input.kind == ElementKind::Quadratic) input.mesh = geometry::make_quadratic(input.mesh);
    input.materials = {{std::move(laws), 1100.0, 2e4}};
    input.fibre.assign(input.mesh.corners.size(), Vec3(0.36, -0.48, 0.8));
    return input;
  }
  /// Every component of the nodes at x = 0.
  static std::vector<HeldDof> held_at_root(const Solid& solid, const Vec3& displacement_m = Vec3::Zero()) {
    std::vector<HeldDof> held;
    for (int n = 0; n < solid.nodes(); ++n) {
      if (solid.rest_m()[3 * n] > 1e-9) continue;
      for (int i = 0; i < 3; ++i) held.push_back({n, i, displacement_m[i]});
    }
    return held;
  }
};

std::string block_name(const ::testing::TestParamInfo<ElementKind>& info) {
  constexpr std::array<const char*, 3> kNames{"linear", "patched", "quadratic"};
  return kNames[static_cast<std::size_t>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(Solid, BlockOf,
                         ::testing::Values(ElementKind::Linear, ElementKind::Patched, ElementKind::Quadratic),
                         block_name);

Eigen::VectorXd carried(const Mat3& turn, const Vec3& way_m, const Eigen::VectorXd& x) {
  Eigen::VectorXd result = x;
  for (Eigen::Index k = 0; k < x.size(); k += 3) result.segment<3>(k) = turn * x.segment<3>(k) + way_m;
  return result;
}

TEST_P(BlockOf, CarriedAboutItHasNoStressAtRestAndTheSameTurnedOneOutOfShape) {
  std::mt19937 random(91);
  std::normal_distribution<double> normal;
  const std::vector<std::vector<Law>> compositions = {
      {StableNeoHookean{1e4, 8e4}},
      {NeoHookean{1e4, 8e4}},
      {MooneyRivlin{8e3, 2e3, 8e4}},
      {Corotated{1e4, 8e4}},
      {StableNeoHookean{1e4, 8e4}, UnsplitFibres<MuscleFibre>{{3e5, 0.9, 1.0}}}};
  for (const std::vector<Law>& laws : compositions) {
    const Solid solid(block(laws), "block");
    const bool pretension = laws.size() > 1;  // a muscle's fibres pull at rest, too
    Eigen::VectorXd bent_m = solid.rest_m();
    for (double& x : bent_m) x += 4e-3 * normal(random);
    Solid::Evaluation here = solid.make_evaluation(), there = solid.make_evaluation();
    solid.evaluate(bent_m, 0.7, Solid::Tangent::None, here);
    const double energy_J = solid.energy_J(bent_m, 0.7);
    for (int round = 0; round < 5; ++round) {
      const Vec3 axis = Vec3::NullaryExpr([&] { return normal(random); }).normalized();
      const Mat3 turn = Eigen::AngleAxisd(3.0 * normal(random), axis).toRotationMatrix();
      const Vec3 way_m = Vec3::NullaryExpr([&] { return normal(random); });
      solid.evaluate(carried(turn, way_m, bent_m), 0.7, Solid::Tangent::None, there);
      EXPECT_LT((there.force_N - carried(turn, Vec3::Zero(), here.force_N)).norm(), 1e-9 * here.force_N.norm());
      EXPECT_NEAR(solid.energy_J(carried(turn, way_m, bent_m), 0.7), energy_J, 1e-9 * std::abs(energy_J));
      if (pretension) continue;
      solid.evaluate(carried(turn, way_m, solid.rest_m()), 0.0, Solid::Tangent::None, there);
      EXPECT_LT(there.force_N.norm(), 1e-9 * here.force_N.norm());
    }
  }
}

TEST_P(BlockOf, ItsSupportBearsItsWeightAndEverythingElseThatPulls) {
  const Solid solid(block({StableNeoHookean{1e5, 8e5}}), "block");
  std::mt19937 random(92);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 3; ++round) {
    SolidLoads loads;
    loads.held = held_at_root(solid, 0.01 * Vec3::NullaryExpr([&] { return normal(random); }));
    loads.gravity_m_s2 = 4.0 * Vec3::NullaryExpr([&] { return normal(random); });
    loads.nodal_force_N = Eigen::VectorXd::NullaryExpr(3 * solid.nodes(), [&] { return normal(random); });
    const StaticResult result = solve_static(solid, loads, solid.rest_m(), {});
    ASSERT_TRUE(result.converged);
    EXPECT_EQ(result.load, 1.0);
    Vec3 force_N = Vec3::Zero(), torque_Nm = Vec3::Zero();
    for (int n = 0; n < solid.nodes(); ++n) {
      const Vec3 pull_N = result.reaction_N.segment<3>(3 * n) + loads.nodal_force_N.segment<3>(3 * n) +
                          solid.mass_kg()[n] * loads.gravity_m_s2;
      force_N += pull_N;
      torque_Nm += result.position_m.segment<3>(3 * n).cross(pull_N);
    }
    const double mass_kg = 1100.0 * kBlock_m.prod();
    EXPECT_NEAR(solid.mass_kg().sum(), mass_kg, 1e-9 * mass_kg);
    // Of the tolerance to which the solver balances the elements' forces, some hundred newtons.
    EXPECT_LT(force_N.norm(), 1e-4);
    EXPECT_LT(torque_Nm.norm(), 1e-4);
    for (const HeldDof& dof : loads.held) {
      const Eigen::Index k = 3 * dof.node + dof.component;
      EXPECT_NEAR(result.position_m[k], solid.rest_m()[k] + dof.displacement_m, 1e-12);
    }
  }
}

/// Pressed through itself: the answer is not the wished-for state, and says so, but one that is in balance.
TEST_P(BlockOf, ALoadThatCannotBeBorneEndsInTheLastStateThatWas) {
  const Solid solid(block({NeoHookean{1e4, 2e4}}), "block");
  SolidLoads loads;
  loads.held = held_at_root(solid);
  for (int n = 0; n < solid.nodes(); ++n) {
    if (solid.rest_m()[3 * n] > kBlock_m.x() - 1e-9) loads.held.push_back({n, 0, -1.5 * kBlock_m.x()});
  }
  StaticOptions options;
  options.most_iterations = 15;  // the last halvings alone would take a second
  const StaticResult result = solve_static(solid, loads, solid.rest_m(), options);
  EXPECT_FALSE(result.converged);
  EXPECT_LT(result.load, 1.0);
  ASSERT_TRUE(result.position_m.allFinite());
  Solid::Evaluation there = solid.make_evaluation();
  out_of_balance({solid, loads}, result.load, result.position_m, Solid::Tangent::None, there);
  EXPECT_GT(there.smallest_J, 0.0);
  HeldSystem(solid, loads.held).drop_held(there.force_N);
  EXPECT_LT(there.force_N.norm(), 1e-6 * there.force_scale_N);
}

}  // namespace
}  // namespace myotact::simulation
