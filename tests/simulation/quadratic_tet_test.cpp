#include "simulation/quadratic_tet.h"

#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "geometry/tet_mesh.h"

namespace myotact::simulation {
namespace {

constexpr std::array<double, 4> kFibrePeaks_Pa = {1e5, 1.2e5, 0.8e5, 1e5};

/// A fibre with stress p (stretch^2 - 1/2): simple, and its energy is p (stretch^3 / 3 - stretch / 2).
FibreStress fibre_of(const TetPoints& points) {
  FibreStress fibre;
  for (std::size_t p = 0; p < 4; ++p) {
    fibre.stress_Pa[p] = kFibrePeaks_Pa[p] * (points.stretch[p] * points.stretch[p] - 0.5);
    fibre.slope_Pa[p] = kFibrePeaks_Pa[p] * 2.0 * points.stretch[p];
  }
  return fibre;
}

struct Element {
  std::array<Vec3, 4> corners{Vec3(0, 0, 0), Vec3(0.010, 0.001, 0), Vec3(0.002, 0.012, 0.001),
                              Vec3(0.001, 0.002, 0.009)};
  TetRest rest = make_tet_rest(corners);
  TissueMaterial material = kMuscleMatrix;
  Vec3 fibre = Vec3(1.0, 0.5, -0.3).normalized();

  Vec3 rest_node(std::size_t a) const {
    if (a < 4) return corners[a];
    const auto [i, j] = geometry::kTetEdges[a - 4];
    return 0.5 * (corners[static_cast<std::size_t>(i)] + corners[static_cast<std::size_t>(j)]);
  }
  TetVector affine(const Mat3& F) const {
    TetVector x{};
    for (std::size_t a = 0; a < kTetNodes; ++a) {
      const Vec3 p = F * rest_node(a);
      for (std::size_t i = 0; i < 3; ++i) x[i * kTetStride + a] = p[static_cast<Eigen::Index>(i)];
    }
    return x;
  }
  /// Large bending and stretching, no inversion.
  TetVector deformed() const {
    Mat3 F;
    F << 1.2, 0.1, 0.0, -0.1, 0.9, 0.2, 0.05, 0.0, 1.05;
    TetVector x = affine(F);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-4e-4, 4e-4);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += k % kTetStride < kTetNodes ? noise(random) : 0.0;
    return x;
  }
  TetPoints points_at(const TetVector& x) const {
    TetPoints points;
    deform(rest, fibre, x, points);
    return points;
  }
  TetVector forces(const TetVector& x) const {
    const TetPoints points = points_at(x);
    return elastic_forces({rest, material, points, fibre, fibre_of(points)});
  }
  TetMatrix stiffness(const TetVector& x, bool definite) const {
    const TetPoints points = points_at(x);
    TetMatrix matrix;
    elastic_stiffness({rest, material, points, fibre, fibre_of(points)}, definite, matrix);
    return matrix;
  }
  /// Energy of the law as it is written down, by itself [J].
  double energy(const TetVector& x) const {
    const TetPoints points = points_at(x);
    const double m = 4.0 / 3.0 * material.shear_Pa, L = material.lambda_Pa + 5.0 / 6.0 * material.shear_Pa;
    const double alpha = 1.0 + m / L - m / (4.0 * L);
    double sum = 4.0 * 0.5 * L * std::pow(points.mean_J - alpha, 2);
    for (std::size_t p = 0; p < 4; ++p) {
      const double s = points.stretch[p];
      sum += 0.5 * m * (points.F_squared[p] - 3.0) - 0.5 * m * std::log(points.F_squared[p] + 1.0) +
             0.5 * material.fluctuation_Pa * std::pow(points.J[p] - points.mean_J, 2) +
             kFibrePeaks_Pa[p] * (s * s * s / 3.0 - s / 2.0);
    }
    return sum * rest.point_volume_m3;
  }
};

Eigen::MatrixXd full(const TetMatrix& half) {
  Eigen::MatrixXd matrix(kTetDofs, kTetDofs);
  TetVector unit{};
  for (int c = 0; c < kTetDofs; ++c) {
    unit.fill(0.0);
    unit[static_cast<std::size_t>(c)] = 1.0;
    const TetVector column = multiply(half, unit);
    for (int r = 0; r < kTetDofs; ++r) matrix(r, c) = column[static_cast<std::size_t>(r)];
  }
  return matrix;
}

}  // namespace

TEST(QuadraticTet, ForcesAreTheSlopeOfTheEnergy) {
  const Element element;
  const TetVector x = element.deformed(), forces = element.forces(x);
  const double h = 1e-7;
  for (std::size_t k = 0; k < x.size(); ++k) {
    TetVector up = x, down = x;
    up[k] += h;
    down[k] -= h;
    EXPECT_NEAR(forces[k], (element.energy(up) - element.energy(down)) / (2.0 * h), 1e-5);  // forces are near 1 N
  }
}

TEST(QuadraticTet, StiffnessIsTheSlopeOfTheForces) {
  const Element element;
  const TetVector x = element.deformed();
  const Eigen::MatrixXd stiffness = full(element.stiffness(x, false));
  const double h = 1e-7;
  for (std::size_t k = 0; k < x.size(); ++k) {
    TetVector up = x, down = x;
    up[k] += h;
    down[k] -= h;
    const TetVector f_up = element.forces(up), f_down = element.forces(down);
    for (std::size_t r = 0; r < x.size(); ++r) {
      EXPECT_NEAR(stiffness(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)),
                  (f_up[r] - f_down[r]) / (2.0 * h), 1e-6 * stiffness.cwiseAbs().maxCoeff());
    }
  }
  EXPECT_LT((stiffness - stiffness.transpose()).norm(), 1e-12 * stiffness.norm());
}

TEST(QuadraticTet, SafeStiffnessHasNoNegativeEigenvalueEvenWhenTurnedInsideOut) {
  const Element element;
  Mat3 mirror = Mat3::Identity();
  mirror(0, 0) = -0.8;
  for (const TetVector& x : {element.deformed(), element.affine(0.3 * Mat3::Identity()), element.affine(mirror)}) {
    const Eigen::MatrixXd stiffness = full(element.stiffness(x, true));
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness).eigenvalues();
    EXPECT_GT(eigenvalues.minCoeff(), -1e-9 * eigenvalues.maxCoeff());
  }
  const Eigen::MatrixXd plain = full(element.stiffness(element.affine(mirror), false));
  EXPECT_LT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(plain).eigenvalues().minCoeff(), 0.0);
}

TEST(QuadraticTet, RestsAtRestAndFeelsNoRotation) {
  Element element;
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const TetPoints points = element.points_at(element.affine(turn));
  const TetVector forces = elastic_forces({element.rest, element.material, points, element.fibre, FibreStress{}});
  for (double f : forces) EXPECT_NEAR(f, 0.0, 1e-9);
  EXPECT_NEAR(points.mean_J, 1.0, 1e-12);
}

TEST(QuadraticTet, GradientsReproduceAnAffineMapAndTheVolume) {
  const Element element;
  Mat3 F;
  F << 1.1, 0.2, -0.1, 0.0, 0.8, 0.3, 0.1, -0.2, 1.3;
  const TetPoints points = element.points_at(element.affine(F));
  for (std::size_t p = 0; p < 4; ++p) {
    for (int k = 0; k < 9; ++k) EXPECT_NEAR(points.F[p][static_cast<std::size_t>(k)], F(k / 3, k % 3), 1e-13);
    EXPECT_NEAR(points.J[p], F.determinant(), 1e-12);
  }
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = element.corners[static_cast<std::size_t>(k + 1)] - element.corners[0];
  EXPECT_NEAR(4.0 * element.rest.point_volume_m3, edges.determinant() / 6.0, 1e-18);
}

namespace {

/// Nominal stress of a uniform state without fibres, from the nodal forces: sum f (x) X = V P.
Mat3 uniform_stress_Pa(const Element& element, const Mat3& F) {
  const TetPoints points = element.points_at(element.affine(F));
  const TetVector forces = elastic_forces({element.rest, element.material, points, element.fibre, FibreStress{}});
  Mat3 moment = Mat3::Zero();
  for (std::size_t a = 0; a < kTetNodes; ++a) {
    for (std::size_t i = 0; i < 3; ++i) {
      moment.row(static_cast<Eigen::Index>(i)) += forces[i * kTetStride + a] * element.rest_node(a).transpose();
    }
  }
  return moment / (4.0 * element.rest.point_volume_m3);
}

/// Lateral stretch at which the sides are free, by bisection.
double free_lateral(const Element& element, double stretch) {
  double low = 0.5, high = 1.5;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (uniform_stress_Pa(element, Vec3(stretch, middle, middle).asDiagonal())(1, 1) < 0.0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

// Stretch, lateral stretch and nominal stress of the stable neo-Hookean law with E 60 kPa, nu 0.49, found from its
// closed form by another program; they are given to the digits compared here.
TEST(QuadraticTet, UniaxialStatesAreThoseOfTheStableNeoHookeanLaw) {
  struct State {
    double stretch, lateral, nominal_Pa;
  };
  Element element;
  element.material = {60e3 / 2.98, 60e3 * 0.49 / (1.49 * 0.02), 40e3, 1000.0};
  for (const State& state : {State{0.8, 1.115082, -15341.999}, State{1.2, 0.914327, 10226.332},
                             State{1.5, 0.818989, 22108.343}, State{1.001, 0.999510, 59.941}}) {
    const double lateral = free_lateral(element, state.stretch);
    EXPECT_NEAR(lateral, state.lateral, 6e-7);
    const Mat3 F = Vec3(state.stretch, lateral, lateral).asDiagonal();
    EXPECT_NEAR(uniform_stress_Pa(element, F)(0, 0), state.nominal_Pa, 6e-4);
  }
}

}  // namespace myotact::simulation
