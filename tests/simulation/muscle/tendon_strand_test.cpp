#include "simulation/muscle/tendon_strand.h"

#include <array>
#include <random>

#include <gtest/gtest.h>

#include "simulation/line/line_model.h"
#include "simulation/muscle/build_tissue.h"
#include "simulation/muscle/strand_layout.h"
#include "support/synthetic_specimen.h"

// Strings from the belly to the bone, straight and round surfaces: energy, slopes, layout.

namespace myotact::simulation {
namespace {

using anatomy::LineWrap;
using geometry::WrapShape;

/// hinged_bones() with a second hinge in the lower body, about another axis.
anatomy::Specimen two_hinges() {
  anatomy::Specimen specimen = testing::hinged_bones();
  specimen.bodies.push_back(specimen.bodies[1]);
  specimen.bodies.back().key = "paw";
  anatomy::Joint wrist = specimen.joints[0];
  wrist.key = "wrist";
  wrist.parent = 1;
  wrist.child = 2;
  wrist.centre_m = Vec3(0.06, 0.002, 0.0);
  wrist.axes = {Vec3(0.2, -0.9, 0.3).normalized()};
  specimen.joints.push_back(wrist);
  return specimen;
}

LineWrap surface(WrapShape shape, int body, const Vec3& centre_m) {
  LineWrap wrap;
  wrap.body = body;
  wrap.shape = shape;
  wrap.centre_m = centre_m;
  wrap.side = Vec3(0.1, 0.0, 1.0).normalized();
  wrap.radii_m.setConstant(0.012);
  if (shape == WrapShape::Ellipsoid) wrap.radii_m = Vec3(0.012, 0.02, 0.014);
  if (shape == WrapShape::Cylinder) wrap.axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return wrap;
}

/// Over both joints: round one surface before the first point, round another before the last.
TendonStrand strand_round(WrapShape shape) {
  TendonStrand strand;
  strand.points = {{1, Vec3(0.035, 0.004, 0.009), surface(shape, 1, Vec3(0.001, 0.0, 0.0))},
                   {2, Vec3(0.1, -0.003, 0.006), surface(WrapShape::Cylinder, 1, Vec3(0.06, 0.0, 0.001))}};
  strand.rest_length_m = 0.14;
  strand.stiffness_N_m = 2e4;
  strand.toe_m = 1e-3;
  return strand;
}

class StrandRound : public ::testing::TestWithParam<WrapShape> {};
INSTANTIATE_TEST_SUITE_P(TendonStrand, StrandRound,
                         ::testing::Values(WrapShape::Cylinder, WrapShape::Sphere, WrapShape::Ellipsoid));

TEST_P(StrandRound, ForcesAreTheSlopesOfTheEnergyAndTheTangentIsTheirs) {
  Skeleton skeleton(two_hinges());
  const TendonStrand strand = strand_round(GetParam());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  constexpr double h = 1e-6;
  for (int pose = 0; pose < 20; ++pose) {
    std::array<double, 2> q{-0.1 + 0.2 * noise(random), -0.1 + 0.2 * noise(random)};
    Vec3 p = Vec3(-0.05, 0.002, 0.006) + 0.004 * Vec3(noise(random), noise(random), noise(random));
    const auto at = [&](const Vec3& end, const std::array<double, 2>& angles) {
      skeleton.set_pose(angles);
      return evaluate_strand(strand, skeleton, end);
    };
    const StrandState here = at(p, q);
    EXPECT_GT(here.tension_N, 0.0);
    const double force = 1e-6 * here.tension_N, stiffness = 1e-6 * here.stiffness_N_m.norm();
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = h * Vec3::Unit(k);
      const StrandState up = at(p + step, q), down = at(p - step, q);
      EXPECT_NEAR(here.pull_N[k], here.tension_N * (up.length_m - down.length_m) / (2 * h), force);
      EXPECT_LT((here.stiffness_N_m.col(k) - (up.pull_N - down.pull_N) / (2 * h)).norm(), stiffness);
      EXPECT_LT((here.coupling_N_rad.row(k).transpose() - (up.torque_Nm - down.torque_Nm) / (2 * h)).norm(), stiffness);
    }
    for (std::size_t j = 0; j < 2; ++j) {
      std::array<double, 2> more = q, less = q;
      more[j] += h;
      less[j] -= h;
      const StrandState up = at(p, more), down = at(p, less);
      const auto column = static_cast<Eigen::Index>(j);
      EXPECT_NEAR(here.torque_Nm[column], here.tension_N * (up.length_m - down.length_m) / (2 * h), force);
      EXPECT_LT((here.coupling_N_rad.col(column) - (up.pull_N - down.pull_N) / (2 * h)).norm(), stiffness);
      EXPECT_LT((here.stiffness_Nm_rad.col(column) - (up.torque_Nm - down.torque_Nm) / (2 * h)).norm(), stiffness);
    }
  }
}

/// A muscle whose tendon goes over a cylinder about the joint; the belly ends at x = -30 mm.
anatomy::Specimen wrapped_muscle() {
  testing::BarShape shape;
  shape.cells = {6, 1, 1};
  shape.tendon_cells = 3;
  anatomy::Specimen specimen = testing::single_muscle(shape);
  LineWrap wrap = surface(WrapShape::Cylinder, 0, Vec3::Zero());
  wrap.after = 1;
  wrap.radii_m.setConstant(0.034);  // its top lies 4 mm above the straight line
  specimen.lines[0].points.back().position_m.x() = 0.04;
  specimen.lines[0].points[1].position_m.x() = -0.04;
  specimen.lines[0].wraps = {wrap};
  return specimen;
}

TEST(TendonStrand, ItGoesRoundWhatTheLineGoesRound) {
  const anatomy::Specimen specimen = wrapped_muscle();
  ASSERT_EQ(anatomy::find_defect(specimen), "");
  const MuscleTissue tissue = build_muscle_tissue(specimen, 0);
  ASSERT_EQ(tissue.strands.size(), 1u);
  const TendonStrand& strand = tissue.strands[0];
  Skeleton skeleton(specimen);
  Vec3 border = Vec3::Zero();
  for (std::size_t k = 0; k < strand.nodes.size(); ++k) {
    border += strand.weights[k] * tissue.mesh.nodes_m[static_cast<std::size_t>(strand.nodes[k])];
  }
  ASSERT_TRUE(strand.points[0].wrap.has_value());
  const double straight_m = (strand.points[0].rest_m - border).norm();
  EXPECT_GT(strand.rest_length_m, straight_m + 1e-4);
  // Its moment arm is the cylinder's radius while it lies on it.
  for (const double q : {-0.2, -0.05, 0.1}) {
    skeleton.set_pose({&q, 1});
    const StrandState state = evaluate_strand(strand, skeleton, border);
    EXPECT_NEAR(state.torque_Nm[0] / state.tension_N, -0.034, 1e-9) << q;
  }
}

TEST(TendonStrand, ALineOfTheSameLengthGivesTheSameMomentArm) {
  const anatomy::Specimen specimen = wrapped_muscle();
  const Skeleton skeleton(specimen);
  LineGeometry geometry;
  measure_line(specimen.lines[0], skeleton, geometry);
  EXPECT_NEAR(geometry.slope_m_rad[0], -0.034, 1e-12);
  EXPECT_NEAR(line_length_m(specimen.lines[0]), geometry.length_m, 1e-15);
}

}  // namespace
}  // namespace myotact::simulation
