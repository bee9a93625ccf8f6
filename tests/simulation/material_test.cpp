#include <random>

#include <gtest/gtest.h>

#include "core/dense_matrix.h"
#include "simulation/simd/batch.h"
#include "simulation/solid/law.h"
#include "simulation/solid/law_batch.h"

// One suite that every law passes.

namespace myotact::simulation {
namespace {

struct NamedLaw {
  const char* name;
  Law law;
  /// Nominal stress at rest that the law has by intent: passive fibres at their reference length are not slack.
  double rest_stress_Pa = 0.0;
  /// Piecewise curves: their energy is a quadrature over the kinks.
  double energy_tolerance = 1e-6;
};

// GoogleTest looks for this name.
// NOLINTNEXTLINE(readability-identifier-naming)
void PrintTo(const NamedLaw& law, std::ostream* out) {
  *out << law.name;
}

constexpr double kShear_Pa = 20e3, kLambda_Pa = 900e3;

const std::vector<NamedLaw>& all_laws() {
  static const std::vector<NamedLaw> laws{
      {"stable_neo_hookean", StableNeoHookean{kShear_Pa, kLambda_Pa}},
      {"neo_hookean", NeoHookean{kShear_Pa, kLambda_Pa}},
      {"mooney_rivlin", MooneyRivlin{6e3, 4e3, kLambda_Pa}},
      {"corotated", Corotated{kShear_Pa, kLambda_Pa}},
      {"blemker_muscle", BlemkerMuscle<BlemkerFibre>{500.0, 700.0, 1e6, {3e5, 1.05}}, 0.0, 1e-3},
      {"blemker_tendon", BlemkerMuscle<ExponentialFibre>{5e3, 5e3, 1e6, {27e3, 4.0, 0.0, 1.2}}, 0.0, 1e-3},
      {"muscle_fibres", UnsplitFibres<MuscleFibre>{{3e5, 0.9, 1.0}}, 3e5 * 0.0094},
      {"muscle_fibres_thelen", UnsplitFibres<MuscleFibre>{{3e5, 0.9, 1.0, CurveSet::Thelen2003}}, 0.0, 1e-3},
      {"muscle_fibres_millard", UnsplitFibres<MuscleFibre>{{3e5, 0.9, 1.0, CurveSet::Millard2012}}, 0.0, 1e-3},
      {"muscle_fibres_isochoric", IsochoricFibres<MuscleFibre>{{3e5, 0.9, 1.0}}, 3e5 * 0.0094},
      {"posed_fibres", UnsplitFibres<PosedFibre>{{3e5, 0.9, 1.1, 0.85, 1.2}}, 3e5 * 0.0094},
      {"blemker_fibres", UnsplitFibres<BlemkerFibre>{{3e5}}, 0.0, 1e-3},
      {"exponential_fibres", UnsplitFibres<ExponentialFibre>{{1e4, 6.0, 0.0, 1.2}}, 0.0, 1e-3},
      {"exponential_fibres_isochoric", IsochoricFibres<ExponentialFibre>{{1e4, 6.0, 0.0, 1.2}}, 0.0, 1e-3},
      {"constant_tension", UnsplitFibres<ConstantTension>{{5e4}}},
      {"calcium_tension", UnsplitFibres<CalciumTension>{{5e4, 4.35, 4.35, 4.75, 1.58, 2.04, 0.97}}, 0.0, 1e-3},
      {"isotropic_tension", IsotropicTension{5e4}}};
  return laws;
}

const Vector3<double> kFibre{0.6, 0.64, 0.48};
const Matrix3<double> kUnit{1, 0, 0, 0, 1, 0, 0, 0, 1};

struct Everything {
  double energy_Pa = 0.0;
  Response<double> response;
};

Everything evaluate(const Law& law, const Matrix3<double>& F, double activation) {
  const Point<double> point = make_point(F, kFibre);
  const std::vector<Law> laws{law};
  return {shape_energy_Pa(laws, point, activation) + volume_energy_Pa(laws, point.J),
          respond_at(laws, point, activation)};
}

/// Deformations from slight to violent; the wildest are inverted.
std::vector<Matrix3<double>> deformations() {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<Matrix3<double>> out;
  for (int k = 0; k < 60; ++k) {
    Matrix3<double> F = kUnit;
    for (double& entry : F) entry += (k < 30 ? 0.12 : 0.6) * normal(random);
    out.push_back(F);
  }
  return out;
}

double size_of(const std::array<double, kPacked>& C) {
  double largest = 0.0;
  for (const double c : C) largest = std::max(largest, std::abs(c));
  return largest;
}

class EveryLaw : public ::testing::TestWithParam<NamedLaw> {};

TEST_P(EveryLaw, IsZeroAtRest) {
  const Everything rest = evaluate(GetParam().law, kUnit, 0.0);
  EXPECT_NEAR(rest.energy_Pa, 0.0, 1e-9);
  for (const double stress : rest.response.P) EXPECT_NEAR(stress, 0.0, 1e-9 + GetParam().rest_stress_Pa);
}

TEST_P(EveryLaw, StressIsTheSlopeOfTheEnergy) {
  constexpr double kStep = 1e-5;
  for (const Matrix3<double>& F : deformations()) {
    const Everything at = evaluate(GetParam().law, F, 0.6);
    double size = 1.0;
    for (const double stress : at.response.P) size = std::max(size, std::abs(stress));
    for (std::size_t k = 0; k < 9; ++k) {
      Matrix3<double> up = F, down = F;
      up[k] += kStep;
      down[k] -= kStep;
      const double slope =
          (evaluate(GetParam().law, up, 0.6).energy_Pa - evaluate(GetParam().law, down, 0.6).energy_Pa) / (2 * kStep);
      EXPECT_NEAR(slope, at.response.P[k], GetParam().energy_tolerance * (size + 1e4))
          << k << " J " << make_point(F, kFibre).J;
    }
  }
}

TEST_P(EveryLaw, TangentIsTheSlopeOfTheStress) {
  constexpr double kStep = 1e-6;
  for (const Matrix3<double>& F : deformations()) {
    const Everything at = evaluate(GetParam().law, F, 0.6);
    const double size = size_of(at.response.C);
    for (std::size_t k = 0; k < 9; ++k) {
      Matrix3<double> up = F, down = F;
      up[k] += kStep;
      down[k] -= kStep;
      const Everything high = evaluate(GetParam().law, up, 0.6), low = evaluate(GetParam().law, down, 0.6);
      for (std::size_t j = 0; j < 9; ++j) {
        const double slope = (high.response.P[j] - low.response.P[j]) / (2 * kStep);
        EXPECT_NEAR(slope, at.response.C[packed(k, j)], 2e-6 * (size + 1e4))
            << k << j << " J " << make_point(F, kFibre).J;
      }
    }
  }
}

TEST_P(EveryLaw, ProjectedTangentIsPositive) {
  for (const Matrix3<double>& F : deformations()) {
    std::array<double, kPacked> C = evaluate(GetParam().law, F, 0.6).response.C;
    const double size = size_of(C);
    make_definite(C);
    Eigen::MatrixXd whole(9, 9);
    for (int r = 0; r < 9; ++r) {
      for (int c = 0; c < 9; ++c) whole(r, c) = C[packed(static_cast<std::size_t>(r), static_cast<std::size_t>(c))];
    }
    EXPECT_GT(symmetric_eigen(whole).values[0], -1e-9 * size - 1e-12);
  }
}

TEST_P(EveryLaw, StaysFiniteWhenCollapsedOrInverted) {
  const Matrix3<double> point{}, plate{1, 0, 0, 0, 1, 0, 0, 0, 0}, line{0, 0, 0, 0, 1, 0, 0, 0, 0};
  const Matrix3<double> mirror{-1, 0, 0, 0, 1, 0, 0, 0, 1}, inside_out{-1, 0, 0, 0, -1, 0, 0, 0, -1};
  for (const Matrix3<double>& F : {point, plate, line, mirror, inside_out}) {
    const Everything at = evaluate(GetParam().law, F, 1.0);
    EXPECT_TRUE(std::isfinite(at.energy_Pa));
    for (const double value : at.response.P) EXPECT_TRUE(std::isfinite(value));
    for (const double value : at.response.C) EXPECT_TRUE(std::isfinite(value));
  }
}

TEST_P(EveryLaw, GivesTheSameBitsOnEveryVectorUnit) {
  const std::vector<Matrix3<double>> all = deformations();
  for (std::size_t first = 0; first + kBatch <= all.size(); first += kBatch) {
    Point<Eight> points;
    for (std::size_t lane = 0; lane < kBatch; ++lane) {
      const Point<double> one = make_point(all[first + lane], kFibre);
      const double* from = reinterpret_cast<const double*>(&one);
      Eight* to = reinterpret_cast<Eight*>(&points);
      for (std::size_t k = 0; k < sizeof(one) / sizeof(double); ++k) to[k].lane[lane] = from[k];
    }
    for (const VectorUnit unit : {VectorUnit::Sse2, VectorUnit::Avx2, VectorUnit::Avx512}) {
      allow_vector_unit(unit);
      Response<Eight> responses;
      respond(GetParam().law, points, 0.6, responses);
      const VolumeTerm<Eight> volume = volume_terms({GetParam().law}, points.J);
      add_volume_at(points, volume, responses);
      for (std::size_t lane = 0; lane < kBatch; ++lane) {
        const Response<double> alone = evaluate(GetParam().law, all[first + lane], 0.6).response;
        for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(responses.P[k].lane[lane], alone.P[k]);
        for (std::size_t k = 0; k < kPacked; ++k) EXPECT_EQ(responses.C[k].lane[lane], alone.C[k]);
      }
    }
    allow_vector_unit(VectorUnit::Avx512);
  }
}

INSTANTIATE_TEST_SUITE_P(Material, EveryLaw, ::testing::ValuesIn(all_laws()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace myotact::simulation
