#include "simulation/line/line_model.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/curves/fibre_curves.h"

namespace myotact::simulation {
namespace {

/// A hinge at the origin about -y; straight antagonist lines from (+-20 mm, 150 mm) to (+-20 mm, -50 mm) in x, z.
/// Length 200 mm, moment arm 20 mm, optimal fibre 100 mm, reached at the file pose.
struct StraightPair {
  anatomy::Specimen specimen;
  std::array<anatomy::Muscle, 2> muscles;
  std::array<anatomy::MuscleLine, 2> lines;
};

StraightPair straight_pair() {
  StraightPair pair;
  pair.specimen.bodies.resize(2);
  anatomy::Joint hinge;
  hinge.key = "hinge";
  hinge.parent = 0;
  hinge.child = 1;
  hinge.axes = {Vec3(0, -1, 0)};
  hinge.range_rad = {{-2.0, 2.0}};
  pair.specimen.joints = {hinge};
  for (std::size_t side = 0; side < 2; ++side) {
    const double x = side == 0 ? 0.02 : -0.02;
    pair.lines[side].points = {{0, Vec3(x, 0, 0.15), anatomy::LinePointKind::Origin},
                               {1, Vec3(x, 0, -0.05), anatomy::LinePointKind::Insertion}};
    pair.muscles[side].peak_force_N = 1000.0;
    pair.muscles[side].optimal_fibre_m = 0.1;
    pair.muscles[side].rest_stretch = 1.0;
  }
  return pair;
}

LineJointTerms pair_terms(const StraightPair& pair, double q_rad, double activation) {
  Skeleton skeleton(pair.specimen);
  LineGeometry rest, now;
  LineJointTerms sum;
  for (std::size_t side = 0; side < 2; ++side) {
    skeleton.set_pose(std::array{0.0});
    measure_line(pair.lines[side], skeleton, rest);
    skeleton.set_pose(std::array{q_rad});
    measure_line(pair.lines[side], skeleton, now);
    sum += line_joint_terms(now, line_force(pair.muscles[side], now.length_m - rest.length_m, 0.0, activation), 0);
  }
  return sum;
}

TEST(LineModel, StraightLineHasTheClosedFormArm) {
  const StraightPair pair = straight_pair();
  const Skeleton skeleton(pair.specimen);
  for (const std::size_t side : {0U, 1U}) {
    LineGeometry geometry;
    measure_line(pair.lines[side], skeleton, geometry);
    EXPECT_NEAR(geometry.length_m, 0.2, 1e-15);
    EXPECT_NEAR(std::abs(geometry.slope_m_rad[0]), 0.02, 1e-15);
    EXPECT_NEAR(geometry.curvature_m_rad2(0, 0), -0.0375, 1e-14);  // -dr/dq, r by its side's own sign
  }
}

// Straight antagonists at their optimum length: published closed form (De Groote-Fregly curves, rigid tendon).
TEST(LineModel, StraightAntagonistsDestabiliseTheJointAsInTheClosedForm) {
  const StraightPair pair = straight_pair();
  constexpr std::array<std::array<double, 2>, 6> kExpected = {
      {{0.0, -0.39024}, {0.01, -1.12742}, {0.1, -7.76207}, {0.25, -18.8198}, {0.5, -37.2494}, {1.0, -74.1086}}};
  for (const auto& [activation, stiffness] : kExpected) {
    EXPECT_NEAR(pair_terms(pair, 0.0, activation).stiffness_Nm_rad(), stiffness, 1e-4) << activation;
    EXPECT_NEAR(pair_terms(pair, 0.0, activation).torque_Nm, 0.0, 1e-12);
  }
}

TEST(LineModel, StiffnessIsTheSlopeOfTheTorque) {
  StraightPair pair = straight_pair();
  // A via point on the moving bone, pennation and another rest stretch: nothing symmetric is left.
  pair.lines[0].points.insert(pair.lines[0].points.begin() + 1,
                              {1, Vec3(0.03, 0.01, -0.01), anatomy::LinePointKind::Via});
  pair.muscles[0].pennation_rad = 0.4;
  pair.muscles[0].rest_stretch = 0.8;
  constexpr double h = 1e-5;
  for (const double q : {-0.5, 0.0, 0.3, 0.9}) {
    for (const double activation : {0.0, 0.3, 1.0}) {
      const double slope =
          -(pair_terms(pair, q + h, activation).torque_Nm - pair_terms(pair, q - h, activation).torque_Nm) / (2 * h);
      EXPECT_NEAR(pair_terms(pair, q, activation).stiffness_Nm_rad(), slope, 1e-6 * (1.0 + std::abs(slope)))
          << q << " " << activation;
    }
  }
}

TEST(LineModel, DerivativesOverTwoJointsMatchDifferences) {
  StraightPair pair = straight_pair();
  pair.specimen.bodies.resize(3);
  anatomy::Joint distal = pair.specimen.joints[0];
  distal.parent = 1;
  distal.child = 2;
  distal.centre_m = Vec3(0.01, 0.0, -0.1);
  distal.axes = {Vec3(0.6, -0.8, 0.0)};
  pair.specimen.joints.push_back(distal);
  anatomy::MuscleLine line = pair.lines[0];
  line.points.push_back({2, Vec3(0.03, 0.01, -0.2), anatomy::LinePointKind::Insertion});
  Skeleton skeleton(pair.specimen);
  const auto measured = [&](double q0, double q1) {
    skeleton.set_pose(std::array{q0, q1});
    LineGeometry geometry;
    measure_line(line, skeleton, geometry);
    return geometry;
  };
  constexpr double h = 1e-5;
  const LineGeometry here = measured(0.4, -0.6);
  for (int j = 0; j < 2; ++j) {
    const double h0 = j == 0 ? h : 0.0, h1 = j == 1 ? h : 0.0;
    const LineGeometry ahead = measured(0.4 + h0, -0.6 + h1), behind = measured(0.4 - h0, -0.6 - h1);
    EXPECT_NEAR(here.slope_m_rad[j], (ahead.length_m - behind.length_m) / (2 * h), 1e-10);
    EXPECT_LT((here.curvature_m_rad2.col(j) - (ahead.slope_m_rad - behind.slope_m_rad) / (2 * h)).norm(), 1e-9);
  }
}

TEST(LineModel, DampingMatchesTheSlopeOfForceVelocity) {
  anatomy::Muscle muscle = straight_pair().muscles[0];
  // Published for F0 1000 N, lo 0.1 m, full activation at the optimum length: 2451.1 N s/m.
  EXPECT_NEAR(line_force(muscle, 0.0, 0.0, 1.0).damping_Ns_m, 2451.1, 0.1);
  muscle.pennation_rad = 0.3;
  constexpr double h = 1e-6;
  const LineForce here = line_force(muscle, 0.005, -0.1, 0.7);
  const double by_speed =
      (line_force(muscle, 0.005, -0.1 + h, 0.7).force_N - line_force(muscle, 0.005, -0.1 - h, 0.7).force_N) / (2 * h);
  const double by_length =
      (line_force(muscle, 0.005 + h, -0.1, 0.7).force_N - line_force(muscle, 0.005 - h, -0.1, 0.7).force_N) / (2 * h);
  EXPECT_NEAR(here.damping_Ns_m, by_speed, 1e-4);
  EXPECT_NEAR(here.stiffness_N_m, by_length, 1e-4);
  EXPECT_NEAR(line_force(muscle, 0.0, 0.0, 1.0).force_N,
              1000.0 * std::cos(0.3) * (active_force_length(1.0) + passive_force_length(1.0)), 1e-9);
  EXPECT_EQ(line_force(muscle, -0.2, 0.0, 1.0).force_N, 0.0);  // slack
}

TEST(LineModel, PlacesOnAPolyline) {
  const std::array<Vec3, 4> points{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(1, 3, 0)};
  const std::vector<double> fractions = arc_fractions(points);
  EXPECT_EQ(fractions, (std::vector<double>{0.0, 0.25, 0.25, 1.0}));
  const LinePlace side = nearest_place(points, fractions, Vec3(2, 1.5, 0));
  EXPECT_EQ(side.segment, 2);
  EXPECT_NEAR(side.fraction, 0.625, 1e-15);
  EXPECT_NEAR(side.distance_m, 1.0, 1e-15);
  EXPECT_NEAR(nearest_place(points, fractions, Vec3(-1, 0, 0)).fraction, 0.0, 1e-15);
  for (const double fraction : {0.0, 0.1, 0.25, 0.6, 1.0}) {
    const LinePlace place = place_at_fraction(points, fractions, fraction);
    EXPECT_NEAR(nearest_place(points, fractions, place.position_m).fraction, fraction, 1e-14);
  }
  EXPECT_EQ(place_at_fraction(points, fractions, 7.0).position_m, points[3]);
}

}  // namespace
}  // namespace myotact::simulation
