#include "simulation/solid/pressure.h"

#include <array>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/box_mesh.h"
#include "geometry/tet_topology.h"

// Pressure all over a closed surface works like p times the volume inside: force and tangent against differences of
// that volume, which is summed tet by tet.

namespace myotact::simulation {
namespace {

constexpr double kOverPressure_Pa = 7e3;
constexpr double kVolumeStep_m = 1e-5;

struct Ball {
  Solid solid;
  std::vector<PressureFace> faces;
  Eigen::VectorXd position_m;  // out of shape
};

/// A box whose nodes are shaken, with its whole surface under pressure. Quadratic sides are then curved.
Ball pressed_box(bool quadratic, unsigned seed) {
  SolidInput input;
  input.kind = quadratic ? ElementKind::Quadratic : ElementKind::Linear;
  input.mesh = geometry::make_box_mesh(Vec3(1.0, 0.8, 1.2), {2, 2, 2});
  if (quadratic) input.mesh = geometry::make_quadratic(input.mesh);
  input.materials = {{{StableNeoHookean{1e4, 4e4}}, 1000.0, 0.0}};
  Ball ball{Solid(input, "box"), {}, {}};
  for (const geometry::BoundaryTriangle& triangle : geometry::boundary_triangles(input.mesh)) {
    const auto& [a, b, c] = triangle.corners;
    const auto& [ab, bc, ca] = triangle.midsides;
    ball.faces.push_back({{a, b, c, ab, bc, ca}, quadratic, kOverPressure_Pa});
  }
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  ball.position_m = ball.solid.rest_m();
  for (double& x : ball.position_m) x += uniform(random);
  return ball;
}

Solid::Evaluation pressure_on(const Ball& ball, const Eigen::VectorXd& position_m, double load = 1.0) {
  Solid::Evaluation out = ball.solid.make_evaluation();
  out.force_N = Eigen::VectorXd::Zero(position_m.size());
  out.stiffness.set_zero();
  for (const PressureFace& face : ball.faces) add_pressure(face, load, position_m, true, out);
  return out;
}

/// Volume inside, by Gauss's theorem over a fine grid of each face: x . n integrated, a third of it.
double enclosed_m3(const Ball& ball, const Eigen::VectorXd& x) {
  constexpr int kGrid = 24;
  double sum = 0.0;
  const auto point = [&](const PressureFace& face, double r, double s) -> Vec3 {
    const double t = 1.0 - r - s;
    const std::array<double, 6> flat{t, r, s, 0, 0, 0};
    const std::array<double, 6> curved{t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1),
                                       4 * t * r,       4 * r * s,       4 * s * t};
    Vec3 p = Vec3::Zero();
    for (std::size_t k = 0; k < (face.quadratic ? 6U : 3U); ++k) {
      p += (face.quadratic ? curved : flat)[k] * x.segment<3>(3 * face.nodes[k]);
    }
    return p;
  };
  for (const PressureFace& face : ball.faces) {
    const int grid = face.quadratic ? kGrid : 1;
    for (int i = 0; i < grid; ++i) {
      for (int j = 0; i + j < grid; ++j) {
        const auto corner = [&](int a, int b) { return point(face, double(i + a) / grid, double(j + b) / grid); };
        sum += corner(0, 0).dot(corner(1, 0).cross(corner(0, 1))) / 6.0;
        if (i + j + 1 < grid) sum += corner(1, 0).dot(corner(1, 1).cross(corner(0, 1))) / 6.0;
      }
    }
  }
  return sum;
}

class PressureOn : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Pressure, PressureOn, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "quadratic" : "linear"; });

TEST_P(PressureOn, AClosedSurfaceNeitherPushesNorTurnsTheBody) {
  const Ball ball = pressed_box(GetParam(), 81);
  const Eigen::VectorXd force_N = pressure_on(ball, ball.position_m).force_N;
  Vec3 sum_N = Vec3::Zero(), torque_Nm = Vec3::Zero();
  for (int n = 0; n < ball.solid.nodes(); ++n) {
    sum_N += force_N.segment<3>(3 * n);
    torque_Nm += ball.position_m.segment<3>(3 * n).cross(force_N.segment<3>(3 * n));
  }
  EXPECT_GT(force_N.norm(), 1e3);
  EXPECT_LT(sum_N.norm(), 1e-10 * force_N.norm());
  EXPECT_LT(torque_Nm.norm(), 1e-10 * force_N.norm());
}

TEST_P(PressureOn, ForceIsThePressureTimesTheSlopeOfTheVolume) {
  // The grid replaces a curved side by flat pieces: its error falls with their size squared.
  const double share = GetParam() ? 1e-3 : 1e-7;
  const Ball ball = pressed_box(GetParam(), 82);
  const Eigen::VectorXd force_N = pressure_on(ball, ball.position_m).force_N;
  std::mt19937 random(83);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 6; ++round) {
    const Eigen::VectorXd way = Eigen::VectorXd::NullaryExpr(force_N.size(), [&] { return normal(random); });
    const double slope_m2 = (enclosed_m3(ball, ball.position_m + kVolumeStep_m * way) -
                             enclosed_m3(ball, ball.position_m - kVolumeStep_m * way)) /
                            (2.0 * kVolumeStep_m);
    // Internal minus external: what pushes outwards counts against the sign of the force.
    EXPECT_NEAR(force_N.dot(way), kOverPressure_Pa * slope_m2, share * force_N.norm() * way.norm());
  }
}

TEST_P(PressureOn, TangentIsTheSlopeOfTheForceAndBothGrowWithTheLoad) {
  const Ball ball = pressed_box(GetParam(), 84);
  const Solid::Evaluation here = pressure_on(ball, ball.position_m),
                          third = pressure_on(ball, ball.position_m, 1.0 / 3.0);
  EXPECT_LT((here.force_N - 3.0 * third.force_N).norm(), 1e-12 * here.force_N.norm());
  const Eigen::SparseMatrix<double> tangent = here.stiffness.lower().selfadjointView<Eigen::Lower>();
  std::mt19937 random(85);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 6; ++round) {
    const Eigen::VectorXd way = Eigen::VectorXd::NullaryExpr(here.force_N.size(), [&] { return normal(random); });
    const Eigen::VectorXd slope = (pressure_on(ball, ball.position_m + kVolumeStep_m * way).force_N -
                                   pressure_on(ball, ball.position_m - kVolumeStep_m * way).force_N) /
                                  (2.0 * kVolumeStep_m);
    EXPECT_LT((tangent * way - slope).norm(), 1e-8 * slope.norm());
  }
}

/// A face alone has a slope that is not symmetric: what a rim does. Its symmetric part is what a factor can hold.
TEST_P(PressureOn, TheTangentOfOneFaceIsTheSymmetricPartOfItsSlope) {
  Ball ball = pressed_box(GetParam(), 87);
  ball.faces.resize(1);
  const Eigen::Index size = ball.position_m.size();
  Eigen::MatrixXd slope(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::VectorXd way = kVolumeStep_m * Eigen::VectorXd::Unit(size, k);
    slope.col(k) =
        (pressure_on(ball, ball.position_m + way).force_N - pressure_on(ball, ball.position_m - way).force_N) /
        (2.0 * kVolumeStep_m);
  }
  EXPECT_GT((slope - slope.transpose()).norm(), 0.1 * slope.norm());
  const Eigen::MatrixXd lower = pressure_on(ball, ball.position_m).stiffness.lower();
  const Eigen::MatrixXd tangent = lower.selfadjointView<Eigen::Lower>();
  EXPECT_LT((tangent - 0.5 * (slope + slope.transpose())).norm(), 1e-8 * slope.norm());
}

TEST_P(PressureOn, ItFollowsTheBodyWhenThatTurns) {
  const Ball ball = pressed_box(GetParam(), 86);
  const Eigen::VectorXd force_N = pressure_on(ball, ball.position_m).force_N;
  const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(0.3, -0.7, 0.5).normalized()).toRotationMatrix();
  Eigen::VectorXd turned_m = ball.position_m, turned_N = force_N;
  for (int n = 0; n < ball.solid.nodes(); ++n) {
    turned_m.segment<3>(3 * n) = turn * ball.position_m.segment<3>(3 * n) + Vec3(5.0, -2.0, 1.0);
    turned_N.segment<3>(3 * n) = turn * force_N.segment<3>(3 * n);
  }
  EXPECT_LT((pressure_on(ball, turned_m).force_N - turned_N).norm(), 1e-10 * force_N.norm());
}

}  // namespace
}  // namespace myotact::simulation
