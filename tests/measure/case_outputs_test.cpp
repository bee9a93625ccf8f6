#include "measure/case_outputs.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace myotact::measure {
namespace {

Mat3 any_stress(std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, 1e4);
  const Mat3 any = Mat3::NullaryExpr([&] { return normal(random); });
  return any + any.transpose();
}

/// Of the principal stresses: the root of half the sum of their squared differences.
TEST(VonMises, IsThatOfThePrincipalStresses) {
  std::mt19937 random(141);
  for (int round = 0; round < 100; ++round) {
    const Mat3 stress_Pa = any_stress(random);
    const Vec3 p = Eigen::SelfAdjointEigenSolver<Mat3>(stress_Pa).eigenvalues();
    const double expected_Pa =
        std::sqrt(0.5 * (std::pow(p[0] - p[1], 2) + std::pow(p[1] - p[2], 2) + std::pow(p[2] - p[0], 2)));
    EXPECT_NEAR(von_mises_Pa(stress_Pa), expected_Pa, 1e-9 * expected_Pa);
    EXPECT_NEAR(von_mises_Pa(stress_Pa + 3e4 * Mat3::Identity()), expected_Pa, 1e-9 * expected_Pa);
  }
  EXPECT_NEAR(von_mises_Pa(Vec3(-7e3, 0.0, 0.0).asDiagonal()), 7e3, 1e-9);
}

/// Five nodes and four tets with made-up values.
SolvedState made_state(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.1, 2.0);
  const auto vector = [&] { return Vec3(Vec3::NullaryExpr([&] { return uniform(random) - 1.0; })); };
  SolvedState state;
  for (int n = 0; n < 5; ++n) state.displacement_m.push_back(vector()), state.reaction_N.push_back(100.0 * vector());
  for (int t = 0; t < 4; ++t) {
    state.cauchy_Pa.push_back(any_stress(random));
    state.stretch.push_back(uniform(random));
    state.volume_ratio.push_back(uniform(random));
    state.rest_volume_m3.push_back(uniform(random));
  }
  state.energy_J = 3.5;
  return state;
}

TEST(CaseOutputs, MeansAreByNodeOrByVolumeAndSumsAreNeither) {
  std::mt19937 random(142);
  for (int round = 0; round < 20; ++round) {
    const SolvedState state = made_state(random);
    const auto value = [&](Quantity quantity, Reduction reduce) {
      CaseOutput output{"", quantity, reduce, {}, {}};
      const bool nodal = quantity == Quantity::Displacement || quantity == Quantity::Reaction;
      nodal ? output.nodes = {0, 2, 3} : output.tets = {1, 3};
      return evaluate_output(output, state);
    };
    const Vec3 sum_m = state.displacement_m[0] + state.displacement_m[2] + state.displacement_m[3];
    const Vec3 sum_N = state.reaction_N[0] + state.reaction_N[2] + state.reaction_N[3];
    const double v1 = state.rest_volume_m3[1], v3 = state.rest_volume_m3[3];
    const Mat3 mean_Pa = (v1 * state.cauchy_Pa[1] + v3 * state.cauchy_Pa[3]) / (v1 + v3);
    const auto mean = value(Quantity::Displacement, Reduction::Mean), sum = value(Quantity::Reaction, Reduction::Sum);
    const auto stress = value(Quantity::Stress, Reduction::Mean);
    ASSERT_EQ(mean.size(), 3u);
    ASSERT_EQ(stress.size(), 6u);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      EXPECT_NEAR(mean[k], sum_m[i] / 3.0, 1e-12);
      EXPECT_NEAR(sum[k], sum_N[i], 1e-9);
      EXPECT_NEAR(stress[k], mean_Pa(i, i), 1e-8);
      EXPECT_NEAR(stress[3 + k], mean_Pa(i, (i + 1) % 3), 1e-8);  // xy, yz, zx
    }
    EXPECT_NEAR(value(Quantity::Stretch, Reduction::Mean)[0],
                (v1 * state.stretch[1] + v3 * state.stretch[3]) / (v1 + v3), 1e-12);
    EXPECT_NEAR(value(Quantity::VolumeRatio, Reduction::Sum)[0], state.volume_ratio[1] + state.volume_ratio[3], 1e-12);
    EXPECT_NEAR(value(Quantity::Stress, Reduction::Max)[0],
                std::max(von_mises_Pa(state.cauchy_Pa[1]), von_mises_Pa(state.cauchy_Pa[3])), 1e-9);
    EXPECT_NEAR(value(Quantity::Displacement, Reduction::L2)[0],
                std::sqrt(state.displacement_m[0].squaredNorm() + state.displacement_m[2].squaredNorm() +
                          state.displacement_m[3].squaredNorm()),
                1e-12);
    EXPECT_EQ(evaluate_output({"", Quantity::Energy, Reduction::Sum, {}, {}}, state), std::vector<double>{3.5});
  }
}

}  // namespace
}  // namespace myotact::measure
