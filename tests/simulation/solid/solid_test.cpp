#include "simulation/solid/solid.h"

#include <random>

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/box_mesh.h"
#include "simulation/solid/solid_motion.h"

namespace myotact::simulation {
namespace {

/// Cube of n x n x n cells of six tets, its inner nodes shaken so that no two tets are alike.
geometry::TetMesh shaken_cube(int n, double shake) {
  geometry::TetMesh mesh = geometry::make_box_mesh(Vec3::Ones(), {n, n, n}, geometry::BoxCells::Alike);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-shake / n, shake / n);
  for (Vec3& x : mesh.nodes_m) {
    const bool inside = x.minCoeff() > 1e-9 && x.maxCoeff() < 1.0 - 1e-9;
    if (inside) x += Vec3(uniform(random), uniform(random), uniform(random));
  }
  return mesh;
}

SolidInput input_of(ElementKind kind, std::vector<Law> laws) {
  SolidInput input;
  input.mesh = shaken_cube(3, 0.25);
  input.kind = kind;
  input.materials = {{std::move(laws), 1060.0, 40e3}};
  input.fibre.assign(input.mesh.corners.size(), Vec3(0.6, 0.64, 0.48));
  return input;
}

const std::vector<Law> kTissue{StableNeoHookean{20e3, 960e3}, UnsplitFibres<MuscleFibre>{{3e5, 0.9, 1.0}}};

Eigen::VectorXd shaken(const Eigen::VectorXd& rest, double size) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Eigen::VectorXd x = rest;
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] += size * normal(random);
  return x;
}

class EveryElement : public ::testing::TestWithParam<ElementKind> {};

TEST_P(EveryElement, ForceIsTheSlopeOfTheEnergy) {
  const Solid solid(input_of(GetParam(), kTissue), "cube");
  const Eigen::VectorXd x = shaken(solid.rest_m(), 0.01), way = shaken(Eigen::VectorXd::Zero(x.size()), 1.0);
  Solid::Evaluation at = solid.make_evaluation();
  solid.evaluate(x, 0.5, Solid::Tangent::None, at);
  constexpr double kStep = 1e-6;
  const double slope = (solid.energy_J(x + kStep * way, 0.5) - solid.energy_J(x - kStep * way, 0.5)) / (2 * kStep);
  EXPECT_NEAR(slope, at.force_N.dot(way), 1e-7 * at.force_N.norm() * way.norm());
}

/// |f(x + e d) - f(x) - e K d| must fall as e^2.
TEST_P(EveryElement, TangentIsSecondOrderRight) {
  const Solid solid(input_of(GetParam(), kTissue), "cube");
  const Eigen::VectorXd x = shaken(solid.rest_m(), 0.01), way = shaken(Eigen::VectorXd::Zero(x.size()), 0.1);
  Solid::Evaluation at = solid.make_evaluation(), there = solid.make_evaluation();
  solid.evaluate(x, 0.5, Solid::Tangent::Exact, at);
  const Eigen::VectorXd linear = at.stiffness.lower().selfadjointView<Eigen::Lower>() * way;
  double last = 0.0;
  for (const double e : {1e-2, 1e-3, 1e-4}) {
    solid.evaluate(x + e * way, 0.5, Solid::Tangent::None, there);
    const double gap = (there.force_N - at.force_N - e * linear).norm();
    if (last > 0.0) {
      EXPECT_NEAR(std::log10(last / gap), 2.0, 0.05);
    }
    last = gap;
  }
}

/// An affine motion of the boundary moves the inside along, with the same stress everywhere.
TEST_P(EveryElement, PassesThePatchTest) {
  SolidInput input = input_of(GetParam(), {StableNeoHookean{20e3, 30e3}});
  input.mesh = shaken_cube(4, 0.25);
  input.fibre.clear();
  const Solid solid(input, "cube");
  EXPECT_GT(input.mesh.corners.size(), 100U);
  Mat3 A;
  A << 1.08, 0.05, -0.03, 0.02, 0.93, 0.06, 0.04, -0.05, 1.03;
  SolidLoads loads;
  for (int n = 0; n < solid.nodes(); ++n) {
    const Vec3 X = solid.rest_m().segment<3>(3 * n);
    if (X.minCoeff() > 1e-9 && X.maxCoeff() < 1.0 - 1e-9) continue;
    const Vec3 u = A * X - X;
    for (int i = 0; i < 3; ++i) loads.held.push_back({n, i, u[i]});
  }
  StaticOptions options;
  options.tolerance = 1e-13;
  const StaticResult result = solve_static(solid, loads, solid.rest_m(), options);
  double worst = 0.0;
  for (int n = 0; n < solid.nodes(); ++n) {
    worst = std::max(worst, (result.position_m.segment<3>(3 * n) - A * solid.rest_m().segment<3>(3 * n)).norm());
  }
  EXPECT_LT(worst, 1e-10);
  const Mat3 first = solid.state_of(0, result.position_m, 0.0).cauchy_Pa;
  for (std::size_t t = 1; t < input.mesh.corners.size(); ++t) {
    EXPECT_LT((solid.state_of(t, result.position_m, 0.0).cauchy_Pa - first).norm(), 1e-9 * first.norm());
  }
}

std::string kind_name(const ::testing::TestParamInfo<ElementKind>& info) {
  constexpr std::array<const char*, 3> kNames{"linear", "patched", "quadratic"};
  return kNames[static_cast<std::size_t>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(Solid, EveryElement,
                         ::testing::Values(ElementKind::Linear, ElementKind::Patched, ElementKind::Quadratic),
                         kind_name);

TEST(Solid, RefusesWhatItCannotSimulate) {
  SolidInput input = input_of(ElementKind::Linear, kTissue);
  std::swap(input.mesh.corners[7][0], input.mesh.corners[7][1]);
  EXPECT_THROW(Solid(input, "cube"), Error);
  input = input_of(ElementKind::Linear, kTissue);
  input.fibre[3] = Vec3::Zero();
  EXPECT_THROW(Solid(input, "cube"), Error);
}

/// Mirrored and shuffled starts come back to rest. Not every one must: a cube may fold through itself into another
/// equilibrium with every J > 0 (linear tets from some shuffled starts, quadratic ones from a single point).
TEST(Solid, RecoversFromInvertedStarts) {
  SolidInput input = input_of(ElementKind::Linear, {StableNeoHookean{20e3, 960e3}});
  input.mesh = shaken_cube(2, 0.0);
  input.fibre.clear();
  for (const ElementKind kind : {ElementKind::Linear, ElementKind::Patched, ElementKind::Quadratic}) {
    input.kind = kind;
    const Solid solid(input, "cube");
    SolidLoads loads;
    for (int n = 0; n < solid.nodes(); ++n) {
      if (solid.rest_m()[3 * n] > 1e-9) continue;
      for (int i = 0; i < 3; ++i) loads.held.push_back({n, i, 0.0});
    }
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(solid.rest_m().size());
    Eigen::VectorXd mirrored = solid.rest_m();
    for (int n = 0; n < solid.nodes(); ++n) mirrored[3 * n] *= -1.0;
    std::vector<Eigen::VectorXd> starts{mirrored};
    if (kind != ElementKind::Quadratic) starts.push_back(zero);
    if (kind == ElementKind::Patched) starts.push_back(shaken(zero, 0.5));
    // From a heap of all nodes about one point, four quadratic cubes in ten come to rest in another equilibrium.
    if (kind == ElementKind::Quadratic) starts.push_back(shaken(solid.rest_m(), 0.2));
    for (const Eigen::VectorXd& start : starts) {
      SolidMotion motion(solid, loads, {0.3, false, 4});
      motion.set_state(start, zero);
      const auto away_m = [&] { return (motion.position_m() - solid.rest_m()).lpNorm<Eigen::Infinity>(); };
      for (int step = 0; step < 200 && !(away_m() < 1e-3); ++step) ASSERT_TRUE(motion.step());
      EXPECT_LT(away_m(), 1e-3) << static_cast<int>(kind);
    }
  }
}

/// Nothing holds the cube but three planes, so that in equilibrium every stress is round-off and no force is left to
/// judge the residual by.
TEST(StaticSolve, FindsTheStressFreeStateOfAFreeContraction) {
  SolidInput input = input_of(ElementKind::Linear, {NeoHookean{1.0, 1.5}, IsotropicTension{0.5}});
  const Solid solid(input, "cube");
  SolidLoads loads;
  loads.activation = 1.0;
  for (int n = 0; n < solid.nodes(); ++n) {
    for (int i = 0; i < 3; ++i) {
      if (solid.rest_m()[3 * n + i] < 1e-9) loads.held.push_back({n, i, 0.0});
    }
  }
  const StaticResult result = solve_static(solid, loads, solid.rest_m(), {});
  EXPECT_TRUE(result.converged);
  EXPECT_LT(solid.state_of(0, result.position_m, 1.0).cauchy_Pa.norm(), 1e-8);
}

}  // namespace
}  // namespace myotact::simulation
