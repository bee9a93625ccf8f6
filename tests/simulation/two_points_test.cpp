// One sphere that rests on two muscles: what they bear together, how they share it, and what only pulls.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "simulation/simulation.h"
#include "support/skin_places.h"
#include "support/synthetic_specimen.h"

namespace myotact::simulation {
namespace {

using messages::ToolState;

constexpr double kCoupling_N_m = 800.0;
const Vec3 kAboveTheMiddle_m(-0.03, 0.0, 1.0);  // of both bars

/// Two bars, the second twice as broad.
anatomy::Specimen soft_and_firm() {
  anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  testing::BarShape broad;
  broad.cells = {4, 1, 1};
  broad.origin_m.z() *= -1.0;
  broad.width_m *= 2.0;
  specimen.muscles[1] = testing::bar_muscle("extensor", broad);
  return specimen;
}

/// A sphere that a hand pushes down, over places of both muscles at once, or of one of them.
class SphereOnTwo {
 public:
  SphereOnTwo() : specimen_(soft_and_firm()), simulation_(specimen_, {}) {
    simulation_.set_joint_locked(0, true);
    const double straight = 0.0;
    EXPECT_TRUE(simulation_.settle({&straight, 1}, {}));
    for (const int m : {0, 1}) {
      triangle_[static_cast<std::size_t>(m)] =
          testing::skin_triangle_near(simulation_, specimen_, m, kAboveTheMiddle_m);
      rest_m_[static_cast<std::size_t>(m)] = place_m(m);
    }
  }

  /// The hand `depth_m` below where the sphere touches each; first on muscle `first`, beside it on the other if not 0.
  void press(int first, double depth_m, double depth_beside_m, int steps = 1) {
    tool_ = {};
    tool_.contact = contact(first, depth_m);
    if (depth_beside_m != 0.0) tool_.beside[0] = contact(1 - first, depth_beside_m);
    for (int i = 0; i < steps; ++i) simulation_.step({&tool_, 1});
    simulation_.write_local_model(tool_, model_, 0);
  }
  /// That the sphere is said to rest on.
  int surface() const { return model_.contact.surface; }
  /// Of the coupling on the tissue.
  Vec3 force_N() const { return to_vec3(model_.contact.force_world_N); }
  Mat3 compliance_m_N() const {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(model_.contact.compliance_m_N.data());
  }
  Vec3 moved_m(int muscle) const { return place_m(muscle) - rest_m_[static_cast<std::size_t>(muscle)]; }

 private:
  Vec3 place_m(int muscle) const {
    return testing::skin_centre_m(simulation_, specimen_, muscle, triangle_[static_cast<std::size_t>(muscle)]);
  }
  messages::ToolContact contact(int muscle, double depth_m) const {
    messages::ToolContact contact;
    contact.surface = muscle;
    contact.triangle = triangle_[static_cast<std::size_t>(muscle)];
    contact.barycentric = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
    contact.normal_world = {0.0, 0.0, 1.0};
    contact.target_world_m = to_array(rest_m_[static_cast<std::size_t>(muscle)] - depth_m * Vec3::UnitZ());
    contact.stiffness_N_m = kCoupling_N_m;
    return contact;
  }

  anatomy::Specimen specimen_;
  Simulation simulation_;
  std::array<int, 2> triangle_{};
  std::array<Vec3, 2> rest_m_;
  ToolState tool_;
  messages::LocalModel model_;
};

/// Where the sphere is below where it began: the hand, less what the coupling gives.
Vec3 sphere_m(double depth_m, const Vec3& force_N) {
  return -depth_m * Vec3::UnitZ() - force_N / kCoupling_N_m;
}

TEST(TwoPoints, TheToldComplianceIsTheSpheres) {
  SphereOnTwo once, twice;
  once.press(0, 1e-4, 1e-4);
  twice.press(0, 2e-4, 2e-4);
  const Vec3 moved_m = sphere_m(2e-4, twice.force_N()) - sphere_m(1e-4, once.force_N());
  EXPECT_LT((once.compliance_m_N() * (twice.force_N() - once.force_N()) - moved_m).norm(), 0.01 * moved_m.norm());
}

TEST(TwoPoints, AtRestEachBearsWhatItsOwnSpringWould) {
  constexpr double kDepth_m = 2e-4;
  constexpr int kToRest = 60;
  double tissue_N_m[2];
  for (const int m : {0, 1}) {
    SphereOnTwo alone;
    alone.press(m, kDepth_m, 0.0, kToRest);
    tissue_N_m[m] = alone.force_N().z() / alone.moved_m(m).z();
    EXPECT_GT(tissue_N_m[m], 50.0);
    EXPECT_LT(tissue_N_m[m], 5000.0);
  }
  SphereOnTwo both;
  both.press(0, kDepth_m, kDepth_m, kToRest);
  const double seat_m_N = 0.03 / kCoupling_N_m;
  const double together_N_m = 1.0 / (1.0 / tissue_N_m[0] + seat_m_N) + 1.0 / (1.0 / tissue_N_m[1] + seat_m_N);
  const double expected_N = -kDepth_m / (1.0 / kCoupling_N_m + 1.0 / together_N_m);
  EXPECT_NEAR(both.force_N().z(), expected_N, 0.03 * std::abs(expected_N));
  for (const int m : {0, 1}) {
    const double share_m = (expected_N / together_N_m) / (1.0 + seat_m_N * tissue_N_m[m]);
    EXPECT_NEAR(both.moved_m(m).z(), share_m, 0.05 * std::abs(share_m)) << m;
  }
}

TEST(TwoPoints, WhatWouldOnlyBePulledIsLeftAlone) {
  SphereOnTwo alone, beside;
  alone.press(0, 2e-4, 0.0);
  beside.press(0, 2e-4, -3e-4);
  EXPECT_LT((alone.force_N() - beside.force_N()).norm(), 1e-9);
  EXPECT_LT((alone.compliance_m_N() - beside.compliance_m_N()).norm(), 1e-9 * alone.compliance_m_N().norm());
  EXPECT_LT(beside.moved_m(1).norm(), 1e-7);
}

TEST(TwoPoints, TheFirstMayBeTheOneThatOnlyPulls) {
  SphereOnTwo alone, beside;
  alone.press(1, 2e-4, 0.0);
  beside.press(0, -3e-4, 2e-4);
  EXPECT_LT((alone.force_N() - beside.force_N()).norm(), 1e-9);
  EXPECT_EQ(beside.surface(), 1) << "what is let go of bears nothing";
  EXPECT_EQ(alone.surface(), 1);
}

/// A hand that jumps by up to 3 mm a step, over one place or the other: whatever a first tangent said, what the sphere
/// is not allowed to press on in the end it does not lie in.
TEST(TwoPoints, NoneIsLeftInsideTheSphere) {
  SphereOnTwo limb;
  std::mt19937 random(30);
  std::uniform_real_distribution<double> depth_m(-1e-3, 2e-3);
  double deepest_m = 0.0;
  for (int step = 0; step < 300; ++step) {
    const std::array<double, 2> depths_m = {depth_m(random), depth_m(random)};
    limb.press(0, depths_m[0], depths_m[1]);
    for (const int m : {0, 1}) {
      const double sphere_z_m = sphere_m(depths_m[static_cast<std::size_t>(m)], limb.force_N()).z();
      deepest_m = std::max(deepest_m, limb.moved_m(m).z() - sphere_z_m);
    }
  }
  std::printf("deepest in the sphere: %.3f mm\n", 1e3 * deepest_m);
  EXPECT_LT(deepest_m, 0.1e-3);  // the seats of one sphere give way by 3 % of 2 mm
}

}  // namespace
}  // namespace myotact::simulation
