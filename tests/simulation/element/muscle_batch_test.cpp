#include "simulation/element/muscle_batch.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/dense_matrix.h"
#include "simulation/element/tet_elements.h"
#include "simulation/muscle/tissue_material.h"

namespace myotact::simulation {
namespace {

constexpr std::array<double, 4> kFibrePeaks_Pa = {1e5, 1.2e5, 0.8e5, 1e5};
constexpr int kDofs = 30;

using Nodes = TetNodeVectors<Eight, QuadraticTet>;
using Positions = Eigen::Matrix<double, kDofs, 1>;

/// One tet in one lane, with its rotated copies in the others, so that a mix-up of lanes would show.
struct Element {
  std::array<Vec3, 4> corners{Vec3(0, 0, 0), Vec3(0.010, 0.001, 0), Vec3(0.002, 0.012, 0.001),
                              Vec3(0.001, 0.002, 0.009)};
  Vec3 fibre = Vec3(1.0, 0.5, -0.3).normalized();
  TetBatch<QuadraticTet> batch;
  static constexpr std::size_t kLane = 5;

  Element() {
    for (std::size_t lane = 0; lane < kBatch; ++lane) {
      std::array<Vec3, 4> scaled = corners;
      for (Vec3& corner : scaled) corner *= 1.0 + 0.1 * (static_cast<double>(lane) - 5.0);
      set_lane(batch, lane, 0, make_tet_shape(scaled, fibre), {});
    }
  }
  Vec3 rest_node(std::size_t a) const {
    if (a < 4) return corners[a];
    const auto [i, j] = geometry::kTetEdges[a - 4];
    return 0.5 * (corners[static_cast<std::size_t>(i)] + corners[static_cast<std::size_t>(j)]);
  }
  Positions affine(const Mat3& F) const {
    Positions x;
    for (std::size_t a = 0; a < 10; ++a) x.segment<3>(static_cast<Eigen::Index>(3 * a)) = F * rest_node(a);
    return x;
  }
  /// Large bending and stretching, no inversion.
  Positions deformed() const {
    Mat3 F;
    F << 1.2, 0.1, 0.0, -0.1, 0.9, 0.2, 0.05, 0.0, 1.05;
    Positions x = affine(F);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-4e-4, 4e-4);
    for (double& k : x) k += noise(random);
    return x;
  }
  PointBatch<QuadraticTet> points_at(const Positions& x) const {
    Nodes nodes;
    for (std::size_t a = 0; a < 10; ++a) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (double& lane : nodes[a][i].lane) lane = x[static_cast<Eigen::Index>(3 * a + i)];
      }
    }
    PointBatch<QuadraticTet> points;
    deform_batch<QuadraticTet>(batch.shapes, nodes, points);
    return points;
  }
  /// Fibres with the stress p (stretch^2 - 1/2): simple, and their energy is p (stretch^3 / 3 - stretch / 2).
  MuscleBatch muscle(const PointBatch<QuadraticTet>& points, double strength = 1.0) const {
    MuscleBatch inputs{batch.shapes, points, kMuscleMatrix.matrix, {}};
    for (std::size_t lane = 0; lane < kBatch; ++lane) {
      inputs.fluctuation_Pa.lane[lane] = kMuscleMatrix.fluctuation_Pa;
      for (std::size_t p = 0; p < 4; ++p) {
        const double stretch = std::sqrt(points[p].I4.lane[lane]);
        inputs.stress_Pa[p].lane[lane] = strength * kFibrePeaks_Pa[p] * (stretch * stretch - 0.5);
        inputs.slope_Pa[p].lane[lane] = strength * kFibrePeaks_Pa[p] * 2.0 * stretch;
      }
    }
    return inputs;
  }
  Positions forces(const Positions& x, double strength = 1.0) const {
    const PointBatch<QuadraticTet> points = points_at(x);
    Nodes forces;
    muscle_forces(muscle(points, strength), forces);
    Positions out;
    for (std::size_t k = 0; k < kDofs; ++k) out[static_cast<Eigen::Index>(k)] = forces[k / 3][k % 3].lane[kLane];
    return out;
  }
  Eigen::MatrixXd stiffness(const Positions& x, bool definite) const {
    const PointBatch<QuadraticTet> points = points_at(x);
    TetBlocks<Eight, QuadraticTet> blocks;
    muscle_stiffness(muscle(points), definite, blocks);
    Eigen::MatrixXd full(kDofs, kDofs);
    std::size_t pair = 0;
    for (int a = 0; a < 10; ++a) {
      for (int b = a; b < 10; ++b, ++pair) {
        Mat3 block;
        for (std::size_t e = 0; e < 9; ++e) {
          block(static_cast<int>(e) / 3, static_cast<int>(e) % 3) = blocks[pair][e].lane[kLane];
        }
        full.block<3, 3>(3 * a, 3 * b) = block;
        full.block<3, 3>(3 * b, 3 * a) = block.transpose();
      }
    }
    return full;
  }
  /// Energy of the law as it is written down, by itself [J].
  double energy(const Positions& x) const {
    const PointBatch<QuadraticTet> points = points_at(x);
    const StableNeoHookean& matrix = kMuscleMatrix.matrix;
    const double m = 4.0 / 3.0 * matrix.shear_Pa, L = matrix.lambda_Pa + 5.0 / 6.0 * matrix.shear_Pa;
    const double alpha = 1.0 + m / L - m / (4.0 * L);
    double mean_J = 0.0, sum = 0.0;
    for (const Point<Eight>& point : points) mean_J += 0.25 * point.J.lane[kLane];
    for (std::size_t p = 0; p < 4; ++p) {
      const double s = std::sqrt(points[p].I4.lane[kLane]), I1 = points[p].I1.lane[kLane];
      sum += 0.5 * m * (I1 - 3.0) - 0.5 * m * std::log(I1 + 1.0) +
             0.5 * kMuscleMatrix.fluctuation_Pa * std::pow(points[p].J.lane[kLane] - mean_J, 2) +
             0.5 * L * std::pow(mean_J - alpha, 2) + kFibrePeaks_Pa[p] * (s * s * s / 3.0 - s / 2.0);
    }
    return sum * 0.25 * batch.shapes.volume_m3.lane[kLane];
  }
};

}  // namespace

TEST(MuscleBatch, ForcesAreTheSlopeOfTheEnergy) {
  const Element element;
  const Positions x = element.deformed(), forces = element.forces(x);
  const double h = 1e-7;
  for (int k = 0; k < kDofs; ++k) {
    Positions up = x, down = x;
    up[k] += h;
    down[k] -= h;
    EXPECT_NEAR(forces[k], (element.energy(up) - element.energy(down)) / (2.0 * h), 1e-5);  // forces are near 1 N
  }
}

TEST(MuscleBatch, StiffnessIsTheSlopeOfTheForces) {
  const Element element;
  const Positions x = element.deformed();
  const Eigen::MatrixXd stiffness = element.stiffness(x, false);
  const double h = 1e-7;
  for (int k = 0; k < kDofs; ++k) {
    Positions up = x, down = x;
    up[k] += h;
    down[k] -= h;
    const Positions slope = (element.forces(up) - element.forces(down)) / (2.0 * h);
    EXPECT_LT((stiffness.col(k) - slope).cwiseAbs().maxCoeff(), 1e-6 * stiffness.cwiseAbs().maxCoeff());
  }
  EXPECT_LT((stiffness - stiffness.transpose()).norm(), 1e-12 * stiffness.norm());
}

TEST(MuscleBatch, SafeStiffnessHasNoNegativeEigenvalueEvenWhenTurnedInsideOut) {
  const Element element;
  Mat3 mirror = Mat3::Identity();
  mirror(0, 0) = -0.8;
  for (const Positions& x : {element.deformed(), element.affine(0.3 * Mat3::Identity()), element.affine(mirror)}) {
    const Eigen::VectorXd eigenvalues = symmetric_eigen(element.stiffness(x, true)).values;
    EXPECT_GT(eigenvalues.minCoeff(), -1e-9 * eigenvalues.maxCoeff());
  }
  const Eigen::MatrixXd plain = element.stiffness(element.affine(mirror), false);
  EXPECT_LT(symmetric_eigen(plain).values.minCoeff(), 0.0);
}

TEST(MuscleBatch, RestsAtRestAndFeelsNoRotation) {
  const Element element;
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_LT(element.forces(element.affine(turn), 0.0).norm(), 1e-9);
}

TEST(MuscleBatch, GivesTheSameBitsOnEveryVectorUnit) {
  const Element element;
  const Positions x = element.deformed();
  std::vector<Eigen::MatrixXd> seen;
  for (const VectorUnit unit : {VectorUnit::Sse2, VectorUnit::Avx2, VectorUnit::Avx512}) {
    allow_vector_unit(unit);
    Eigen::MatrixXd all(kDofs, kDofs + 1);
    all << element.stiffness(x, false), element.forces(x);
    seen.push_back(all);
  }
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_EQ(seen[0], seen[2]);
}

TEST(FibreStretchSlopes, AreTheSlopeOfTheIntegral) {
  const Element element;
  const Positions x = element.deformed();
  const auto integral = [&](const Positions& at) {
    double sum = 0.0;
    for (const Point<Eight>& point : element.points_at(at)) sum += std::sqrt(point.I4.lane[Element::kLane]);
    return 0.25 * element.batch.shapes.volume_m3.lane[Element::kLane] * sum;
  };
  Nodes slopes;
  fibre_stretch_slopes(element.batch.shapes, element.points_at(x), slopes);
  for (std::size_t k = 0; k < kDofs; ++k) {
    Positions up = x, down = x;
    up[static_cast<Eigen::Index>(k)] += 1e-7;
    down[static_cast<Eigen::Index>(k)] -= 1e-7;
    EXPECT_NEAR(slopes[k / 3][k % 3].lane[Element::kLane], (integral(up) - integral(down)) / 2e-7, 1e-11);
  }
}

}  // namespace myotact::simulation
